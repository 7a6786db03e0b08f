#pragma once
// The velocity gradient on triangles and tetrahedra with a solid: of second order, of one side.

#include <span>
#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// Collective. Whether the mesh has triangles or tetrahedra.
bool has_simplices(const Mesh& mesh);

/// Sets L in the solid's cells (alpha >= 1/2) and those that share a vertex with one.
///
/// A triangle is not symmetric about its centre: the library's gradient is off by a part of
/// h grad grad u that changes sign from cell to cell, and the strain keeps it. At the surface,
/// where u has a kink, a gradient over both sides is off by a part of the jump besides, which the
/// non-orthogonal part of the viscous flux passes on to the velocity.
///
/// Here L is that of a quadratic (QuadraticFit) through the values of the vertex neighbours on the
/// cell's own side of alpha = 1/2 and of the cell's boundary faces. Cells of the solid beside its
/// surface take the gradients of those farther in as well. Where that does not tell it, L is the
/// linear fit of the own side (one_sided.hpp).
class SidedGradient {
 public:
  explicit SidedGradient(const Mesh& mesh) : mesh_(mesh), deep_(mesh) {}

  /// Collective. cells: owned, as above. L on entry: the library's gradient there; L, u, alpha:
  /// owned and halo.
  void apply(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
             const CellField<Real>& alpha, std::span<const Index> cells);

 private:
  const Mesh& mesh_;
  CellField<Real> deep_;  // 1: in the solid, with all vertex neighbours
  std::vector<Index> last_deep_;
};

}  // namespace fsi::solid
