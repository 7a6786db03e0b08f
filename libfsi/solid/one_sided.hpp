#pragma once
// The velocity gradient on the solid's side of its surface.

#include "libfsi/core/eigen.hpp"
#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// L at owned cell c from the solid alone:
///   min over L of sum_n w |u_n - u_c - L . d|^2,  w = 1 / |d|^2,
/// over the vertex neighbours n with known(n). Exact for a linear u; of first order where they lie
/// on one side. In directions in which they do not spread, L_c, the gradient over all neighbours.
/// u: owned and halo.
template <class Known>
Tensor one_sided_gradient(const Tensor& L_c, const CellField<Vec3>& u, const Known& known,
                          const Mesh& mesh, Index c) {
  SymTensor M;
  Tensor rest;  // sum w (u_n - u_c - L_c . d) (x) d
  for (Index k = mesh.cell_neighbours.offset[c]; k < mesh.cell_neighbours.offset[c + 1]; ++k) {
    const Index n = mesh.cell_neighbours.index[k];
    if (!known(n)) continue;
    const Vec3 d = mesh.C[n] - mesh.C[c] + mesh.translation[mesh.cell_neighbour_shift[k]];
    const Real w = 1 / norm2(d);
    M += w * SymTensor{d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
    rest += outer(w * (u[n] - u[c] - dot(L_c, d)), d);
  }
  constexpr Real flat = 0.05;  // part of the largest spread that counts as none
  const Eigen e = eigen(M);
  Tensor L = L_c;
  for (std::size_t i = 0; i < 3; ++i)
    if (e.value[i] > flat * e.value[2])
      L += outer((1 / e.value[i]) * dot(rest, e.vector[i]), e.vector[i]);
  return L;
}

}  // namespace fsi::solid
