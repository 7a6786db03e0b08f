#include "libfsi/solid/neo_hookean.hpp"

namespace fsi::solid {

NeoHookean::NeoHookean(const Mesh& mesh, Real G) : mesh_(mesh), G_(G) {}

void NeoHookean::apply(CellField<Vec3>& force, FaceField<Real>& balance,
                       const CellField<SymTensor>& aB, const FaceWeights& weights,
                       const GradientStencil& stencil, const Band& band,
                       CellField<SymGradient>& grad) {
  for (const Index c : last_cells_) force[c] = {}, grad[c] = {};
  for (const Index f : last_faces_) {
    balance[f] = 0;
    // The outermost faces push at cells beyond the band.
    force[mesh_.owner[f]] = {};
    if (f < mesh_.n_internal) force[mesh_.neighbour[f]] = {};
  }
  last_cells_ = band.cells();
  last_faces_ = band.faces();

  // tau = G dev(alpha B) is linear in alpha B: its gradients and face values follow from those
  gradient(grad, aB, stencil, mesh_, band.cells());
  mesh_.halo.update(grad);
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    if (f >= mesh_.n_internal) {
      // tau_b = tau_P + grad tau . d
      const SymTensor aB_b = aB[P] + along(grad[P], mesh_.d[f]);
      force[P] += (1 / mesh_.V[P]) * dot(G_ * dev(aB_b), mesh_.Sf[f]);
      continue;
    }
    const Index N = mesh_.neighbour[f];
    const Real lambda = weights.lambda[f];
    const auto between = [lambda](const SymTensor& a, const SymTensor& b) {
      return (1 - lambda) * a + lambda * b;
    };
    const SymGradient grad_f{between(grad[P].x, grad[N].x), between(grad[P].y, grad[N].y),
                             between(grad[P].z, grad[N].z)};
    // tau_f = (1 - lambda) tau_P + lambda tau_N + (grad tau)_f . skew
    SymTensor aB_f = between(aB[P], aB[N]);
    if (weights.skewed) aB_f += along(grad_f, weights.skew[f]);
    const Vec3 t = dot(G_ * dev(aB_f), mesh_.Sf[f]);
    force[P] += (1 / mesh_.V[P]) * t;
    force[N] -= (1 / mesh_.V[N]) * t;
    const Vec3 d = mesh_.d[f], n = d / norm(d);
    balance[f] = dot(n, dot(G_ * dev(aB[N] - aB[P] - along(grad_f, d)), n));
  }
  mesh_.halo.update(force);
}

void add_body_force(CellField<Vec3>& force, const CellField<Real>& alpha, const Vec3& f,
                    const Mesh& mesh, std::span<const Index> cells) {
  if (f == Vec3{}) return;
  for (const Index c : cells) force[c] += alpha[c] * f;
  mesh.halo.update(force);
}

}  // namespace fsi::solid
