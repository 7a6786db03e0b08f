#pragma once
// The number of pieces of a solid.

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::analysis {

/// Collective. Number of the sets of cells with alpha > 1/2 that are connected by their corners,
/// also across a period, and whose solid, sum alpha V, is `least` or more. alpha: owned and halo.
int pieces(const CellField<Real>& alpha, Real least, const Mesh& mesh);

}  // namespace fsi::analysis
