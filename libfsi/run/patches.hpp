#pragma once
// The conditions at the patches of a mesh and the start of a solid, from the names of the case
// file.

#include "libfsi/core/options.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/run/case.hpp"

namespace fsi {

/// Collective. The condition of each patch of the mesh from its options patches_NAME_type and the
/// further options of that type (with -help: those of a patch called NAME). A patch called wall or
/// symmetry needs none. Errors: Error{input} if a patch has no type, or an option is of no patch or
/// not of the type of its patch, or of two patches. Also if an option that the type needs is
/// missing, or a value or a file does not fit.
Conditions read_patches(Options& options, const Mesh& mesh);
/// The options of `read_patches` and `read_mesh_and_place`, for -help without a mesh.
void list_vessel_options(Options& options);

/// Collective. Reads the mesh of the case. With -solid_path a,b and -solid_arc_length s: puts the
/// solid on the vessel's centre line from patch a to patch b, at the arc length s from a. Its axis
/// of revolution lies along the line (turned from it by -solid_angle about z). Without these
/// options it does nothing. For a solid with the shape none they are ignored, as its other options
/// are. Several ranks then read the mesh a second time, divided so that they share the solid.
/// Errors: Error{input}.
Mesh read_mesh_and_place(Case& setup, Options& options);

}  // namespace fsi
