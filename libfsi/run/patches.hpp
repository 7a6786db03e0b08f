#pragma once
// What stands at the patches of a mesh, and where a solid starts, by the names of the case file.

#include "libfsi/core/options.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/run/case.hpp"

namespace fsi {

/// Collective. The condition of each patch of the mesh from its options patches_NAME_type and what
/// that type needs (with -help: those of a patch called NAME). A patch called wall or symmetry may
/// go without. Errors: Error{input} where a patch has no type, or a value or a file does not fit.
Conditions read_patches(Options& options, const Mesh& mesh);
/// The options of `read_patches` and `place_solids`, for -help without a mesh.
void list_vessel_options(Options& options);

/// Collective. The numbers of a csv file, row by row, each of `columns`; lines that begin with
/// neither a digit, a sign nor a point are left out. Errors: Error{input}.
std::vector<std::vector<Real>> read_rows(const std::string& file, std::size_t columns);

/// Collective. The second column over the first, straight lines between the rows, the first and
/// last value beyond them; period > 0: again and again. Errors: Error{input}.
OfTime series(const std::string& file, Real period = 0);

/// Collective. With -solid_path a,b and -solid_arc_length s: puts the solid on the vessel's centre
/// line from patch a to patch b, s along it from a, its axis of revolution along the line (turned
/// from it by -solid_angle about z). Without: nothing. Errors: Error{input}.
void place_solids(std::vector<SolidSetup>& solids, Options& options, const Mesh& mesh);

}  // namespace fsi
