#pragma once
// The direction into the solid at a cell of its surface.

#include <cmath>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::solid {

/// The unit vector -m into the solid, along
///   sum_k (alpha_k - alpha_c) r_k / |r_k|^2
/// over the vertex neighbours k of cell c. It is zero if alpha is symmetric about the cell.
/// symmetry: faces beyond which the images of cells count as neighbours. alpha: owned and halo.
inline Vec3 inward_normal(const CellField<Real>& alpha, const Mesh& mesh, Index c,
                          const SymmetryFaces& symmetry = {}) {
  Vec3 n;
  Real size = 0;
  for_neighbours_and_images(c, symmetry, mesh,
                            [&](Index k, const Vec3& d, const Reflection& /*n*/) {
                              n += ((alpha[k] - alpha[c]) / norm2(d)) * d;
                              size += std::abs(alpha[k] - alpha[c]) / norm(d);
                            });
  constexpr Real alike = 1e-6;
  return norm(n) > alike * size ? n / norm(n) : Vec3{};
}

}  // namespace fsi::solid
