#pragma once
// What stands at the patches of a mesh, and where a solid starts, by the names of the case file.

#include "libfsi/core/options.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/run/case.hpp"

namespace fsi {

/// Collective. The condition of each patch of the mesh from its options patches_NAME_type and what
/// that type needs (with -help: those of a patch called NAME). A patch called wall or symmetry may
/// go without. Errors: Error{input} where a patch has no type, an option is of no patch or not of
/// the type of its patch. So it is where something that the type needs is missing, or a value or a
/// file does not fit.
Conditions read_patches(Options& options, const Mesh& mesh);
/// The options of `read_patches` and `place_solids`, for -help without a mesh.
void list_vessel_options(Options& options);

/// Collective. With -solid_path a,b and -solid_arc_length s: puts the solid on the vessel's centre
/// line from patch a to patch b, s along it from a. Its axis of revolution lies along the line
/// (turned from it by -solid_angle about z). Without: nothing. Of a solid with the shape none both
/// are left
/// aside, as its other options are. Errors: Error{input}.
void place_solids(std::vector<SolidSetup>& solids, Options& options, const Mesh& mesh);

}  // namespace fsi
