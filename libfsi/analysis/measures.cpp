#include "libfsi/analysis/measures.hpp"

#include <algorithm>
#include <limits>

#include "libfsi/core/eigen.hpp"

namespace fsi::analysis {

Health health(const CellField<SymTensor>& B, const CellField<Real>& alpha, const Mesh& mesh) {
  constexpr Real none = std::numeric_limits<Real>::max();
  Health h{.det_min = none, .det_max = -none, .eigenvalue_min = none};
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (!(alpha[c] > 0.5)) continue;
    const Real d = det(B[c]);
    h.det_min = std::min(h.det_min, d), h.det_max = std::max(h.det_max, d);
    h.eigenvalue_min = std::min(h.eigenvalue_min, eigen(B[c]).value[0]);
  }
  h = {.det_min = global_min(h.det_min),
       .det_max = global_max(h.det_max),
       .eigenvalue_min = global_min(h.eigenvalue_min)};
  return h.det_min == none ? Health{} : h;
}

Real kinetic_energy(const CellField<Real>& rho, const CellField<Vec3>& u, const Mesh& mesh) {
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) sum.add(rho[c] * norm2(u[c]) * mesh.V[c] / 2);
  return sum.total();
}

Real twice_strain_squared(const Tensor& L) {
  const Tensor twice_D = L + transpose(L);
  return trace(dot(twice_D, twice_D)) / 2;
}

Real dissipation(const CellField<Real>& mu, const CellField<Tensor>& L, const Mesh& mesh) {
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) sum.add(mu[c] * mesh.V[c] * twice_strain_squared(L[c]));
  return sum.total();
}

void q_criterion(CellField<Real>& Q, const CellField<Tensor>& L) {
  // |W|^2 - |D|^2 = -tr(L L).
  for (Index c = 0; c < Q.size(); ++c) {
    const Tensor& l = L[c];
    Q[c] =
        -(l.xx * l.xx + l.yy * l.yy + l.zz * l.zz) / 2 - (l.xy * l.yx + l.xz * l.zx + l.yz * l.zy);
  }
}

}  // namespace fsi::analysis
