#include "libfsi/solid/one_sided.hpp"

#include "libfsi/core/eigen.hpp"

namespace fsi::solid {

Tensor one_sided_gradient(const Tensor& L_c, const CellField<Vec3>& u, const CellField<Real>& alpha,
                          Real alpha_min, const Mesh& mesh, Index c) {
  SymTensor M;
  Tensor rest;  // sum w (u_n - u_c - L_c . d) (x) d
  for (Index k = mesh.cell_neighbours.offset[c]; k < mesh.cell_neighbours.offset[c + 1]; ++k) {
    const Index n = mesh.cell_neighbours.index[k];
    if (alpha[n] < alpha_min) continue;
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
