#pragma once
// How an inflow is spread over its patch.

#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// plug: the same everywhere; parabola: that of developed flow in a straight vessel whose section
/// is the patch, of any outline.
enum class InflowProfile { plug, parabola };

/// Collective. [faces of the patch on this rank] the velocity that carries a flow rate of 1 into
/// the domain: u = -n w / int w dA, n the mean normal of the patch. plug: w = 1. parabola: in the
/// patch
///   Lap w = -1,   w = 0 at its rim,
/// by linear finite elements on its faces; a period of the mesh is no part of the rim. The mean
/// over a face is taken. free: patches without friction (planes of symmetry), along which the rim
/// has no condition; where all of the rim is along them, w = 1. Errors: Error{input} where the
/// whole patch is one row of faces, so that no corner lies inside.
std::vector<Vec3> inflow_shape(InflowProfile profile, const Patch& patch, const Mesh& mesh,
                               const std::vector<Patch>& free);

}  // namespace fsi
