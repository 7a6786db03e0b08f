#pragma once
// Values at points.

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::analysis {

/// A point and the cell whose centre is nearest to it; cell = -1 on every rank but its owner.
struct Probe {
  Vec3 offset;      ///< point - centre of the cell
  Index cell = -1;  ///< on this rank; -1: on none
};

/// Collective. Ties go to the cell that comes first in the mesh as read.
Probe probe(const Mesh& mesh, const Vec3& point);

/// Collective. value + gradient . offset, on every rank: second order where the gradient is first.
Real sample(const Probe& at, const CellField<Real>& value, const CellField<Vec3>& gradient);
/// The same for a velocity, L_ij = du_i/dx_j.
Vec3 sample(const Probe& at, const CellField<Vec3>& u, const CellField<Tensor>& L);

}  // namespace fsi::analysis
