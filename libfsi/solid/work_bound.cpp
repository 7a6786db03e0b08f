#include "libfsi/solid/work_bound.hpp"

namespace fsi::solid {
namespace {

/// What viscosities in series add to L* at a face, over w_f alpha_f. The power of the stress
/// (mu_h / mu_s - 1) (b m + m b), b = (T . m)_t, on the velocity difference v is T : the result.
Tensor of_traction(const Vec3& v, const Vec3& S, const Vec3& m, Real alpha_f, Real ratio) {
  const Vec3 vm = dot(S, m) * v + dot(v, m) * S;  // (v S + S v) . m
  const Real series = 1 / (alpha_f + (1 - alpha_f) * ratio);
  return (series - 1) * outer(vm - dot(vm, m) * m, m);
}

}  // namespace

Tensor excess_of_work(const Tensor& L, const FlowSnapshot& snapshot, const CellField<Real>& alpha,
                      const Extension& extension, const Mesh& mesh, Index c) {
  const auto& [alpha_f, normal, fraction] = *snapshot.cuts;
  Tensor sum;
  Real volume = 0;
  const auto add = [&](Index f, Real w, Real mean, const Vec3& d, const Vec3& rise,
                       const Tensor& L_f) {
    const Vec3 S = mesh.Sf[f], e = rise - dot(L_f, d);
    sum += (w * alpha_f[f]) * outer(e, S) +
           (w * (mean - alpha_f[f]) * dot(e, S)) * outer(normal[f], normal[f]);
    if (snapshot.in_series != 1 && f < mesh.n_internal)
      sum += (w * alpha_f[f]) * of_traction(rise, S, normal[f], alpha_f[f], snapshot.in_series);
    volume += w * mean * dot(d, S) / static_cast<Real>(mesh.dim);
  };
  for (const Index f : mesh.cell_faces[c]) {
    const Index P = mesh.owner[f];
    if (f >= mesh.n_internal) {
      const Index b = f - mesh.n_internal;
      if (extension.symmetry().has(f, mesh)) {  // the face to the image of the cell
        const Vec3 n = mesh.normal(f);
        const Tensor image_of_L = image(snapshot.L[c], n);
        add(f, 0.5, fraction[P], (2 * dot(mesh.d[f], n)) * n,
            image(snapshot.u[P], n) - snapshot.u[P],
            extension.inner(c) ? 0.5 * (L + image_of_L) : L);
      } else if (snapshot.contact != nullptr && snapshot.contact->touched[b] != 0)
        add(f, 1, fraction[P], mesh.d[f], snapshot.contact->u_b[b] - snapshot.u[P], L);
      continue;
    }
    const Index N = mesh.neighbour[f], other = P == c ? N : P;
    const Real part = P == c ? 1 - snapshot.weights.lambda[f] : snapshot.weights.lambda[f];
    add(f, alpha[other] >= alpha_known ? part : 1, (fraction[P] + fraction[N]) / 2, mesh.d[f],
        snapshot.u[N] - snapshot.u[P], extension.inner(other) ? 0.5 * (L + snapshot.L[other]) : L);
  }
  return volume > 0 ? (1 / volume) * sum : Tensor{};
}

}  // namespace fsi::solid
