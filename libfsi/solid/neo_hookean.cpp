#include "libfsi/solid/neo_hookean.hpp"

namespace fsi::solid {

NeoHookean::NeoHookean(const Mesh& mesh, Real G) : mesh_(mesh), G_(G), slope_(mesh) {}

void NeoHookean::clear(CellField<Vec3>& force, FaceField<Real>& balance,
                       CellField<SymGradient>& grad, const Band& band) {
  for (const Index c : last_cells_) force[c] = {}, grad[c] = {}, slope_[c] = {};
  for (const Index f : last_faces_) {
    balance[f] = 0;
    // The outermost faces push at cells beyond the band.
    force[mesh_.owner[f]] = {};
    if (f < mesh_.n_internal) force[mesh_.neighbour[f]] = {};
  }
  last_cells_ = band.cells();
  last_faces_ = band.faces();
}

void NeoHookean::set_slope(const CellField<Real>& alpha, const GradientStencil& stencil,
                           const Band& band) {
  for (const Index c : band.cells())
    for (const Index f : mesh_.cell_faces[c]) {
      if (f >= mesh_.n_internal) continue;
      const bool owner = mesh_.owner[f] == c;
      const Index n = owner ? mesh_.neighbour[f] : mesh_.owner[f];
      slope_[c] += (alpha[n] - alpha[c]) * (owner ? stencil.owner[f] : stencil.neighbour[f]);
    }
  mesh_.halo.update(slope_, band.listed());
}

void NeoHookean::push(CellField<Vec3>& force, const Strained& solid, const FaceWeights& weights,
                      const Band& band, const CellField<SymGradient>& grad) const {
  const CellField<SymTensor>& B = solid.B;
  const CellField<Real>& alpha = solid.alpha;
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    if (f >= mesh_.n_internal) continue;
    const Index N = mesh_.neighbour[f];
    const Real lambda = weights.lambda[f];
    // T_f = (1 - lambda) T_P + lambda T_N + (grad T)_f . skew, T = B or alpha B
    const bool sharp = solid.alpha_f != nullptr;
    const Real a_P = sharp ? 1 : alpha[P], a_N = sharp ? 1 : alpha[N];
    SymTensor T = (1 - lambda) * a_P * B[P] + lambda * a_N * B[N];
    if (weights.skewed)
      T +=
          (1 - lambda) * along(grad[P], weights.skew[f]) + lambda * along(grad[N], weights.skew[f]);
    const Vec3 t = dot((sharp ? (*solid.alpha_f)[f] : 1) * G_ * dev(T), mesh_.Sf[f]);
    force[P] += (1 / mesh_.V[P]) * t;
    force[N] -= (1 / mesh_.V[N]) * t;
  }
}

void NeoHookean::apply(CellField<Vec3>& force, FaceField<Real>& balance, const Strained& solid,
                       const FaceWeights& weights, const GradientStencil& stencil, const Band& band,
                       CellField<SymGradient>& grad) {
  const CellField<SymTensor>& B = solid.B;
  const CellField<Real>& alpha = solid.alpha;
  clear(force, balance, grad, band);
  gradient(grad, alpha, B, stencil, mesh_, band.cells());
  mesh_.halo.update(grad, band.listed());
  if (solid.along_normal) set_slope(alpha, stencil, band);
  constexpr Real level = 1e-6;  // change of alpha across a face that counts as none
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    const Vec3 d = mesh_.d[f];
    if (f >= mesh_.n_internal) {
      // tau_b = tau_P + grad tau . d
      const SymTensor aB_b = alpha[P] * B[P] + along(grad[P], d);
      force[P] += (1 / mesh_.V[P]) * dot(G_ * dev(aB_b), mesh_.Sf[f]);
      continue;
    }
    const Index N = mesh_.neighbour[f];
    const Real lambda = weights.lambda[f];
    const SymTensor rise = (1 - lambda) * along(grad[P], d) + lambda * along(grad[N], d);
    const Vec3 slope = (1 - lambda) * slope_[P] + lambda * slope_[N];
    const Vec3 n = norm(slope) * norm(d) > level ? slope / norm(slope) : d / norm(d);
    balance[f] = dot(n, dot(G_ * dev(alpha[N] * B[N] - alpha[P] * B[P] - rise), n));
  }
  if (weights.skewed && solid.alpha_f != nullptr) {
    for (const Index c : band.cells()) grad[c] = {};  // of B, which is level around the solid
    gradient(grad, B, stencil, mesh_, band.core());
    mesh_.halo.update(grad, band.listed());
  }
  push(force, solid, weights, band, grad);
  mesh_.halo.update(force);
}

}  // namespace fsi::solid
