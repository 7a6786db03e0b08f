#include "libfsi/solid/work_bound.hpp"

namespace fsi::solid {

Tensor excess_of_work(const Tensor& L, const FlowSnapshot& snapshot, const CellField<Real>& alpha,
                      const Extension& extension, const Mesh& mesh, Index c) {
  const auto& [alpha_f, normal, fraction] = *snapshot.cuts;
  Tensor sum;
  Real volume = 0;
  const auto add = [&](Index f, Real w, Real mean, const Vec3& rise, const Tensor& L_f) {
    const Vec3 S = mesh.Sf[f], d = mesh.d[f], e = rise - dot(L_f, d);
    sum += (w * alpha_f[f]) * outer(e, S) +
           (w * (mean - alpha_f[f]) * dot(e, S)) * outer(normal[f], normal[f]);
    volume += w * mean * dot(d, S) / static_cast<Real>(mesh.dim);
  };
  for (const Index f : mesh.cell_faces[c]) {
    const Index P = mesh.owner[f];
    if (f >= mesh.n_internal) {
      const Index b = f - mesh.n_internal;
      if (snapshot.contact != nullptr && snapshot.contact->touched[b] != 0)
        add(f, 1, fraction[P], snapshot.contact->u_b[b] - snapshot.u[P], L);
      continue;
    }
    const Index N = mesh.neighbour[f], other = P == c ? N : P;
    const Real part = P == c ? 1 - snapshot.weights.lambda[f] : snapshot.weights.lambda[f];
    add(f, alpha[other] >= alpha_known ? part : 1, (fraction[P] + fraction[N]) / 2,
        snapshot.u[N] - snapshot.u[P], extension.inner(other) ? 0.5 * (L + snapshot.L[other]) : L);
  }
  return volume > 0 ? (1 / volume) * sum : Tensor{};
}

}  // namespace fsi::solid
