#include "libfsi/solid/neo_hookean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fsi::solid {

NeoHookean::NeoHookean(const Mesh& mesh, Real G) : mesh_(mesh), G_(G), tau_(mesh), grad_(mesh) {}

void NeoHookean::apply(CellField<Vec3>& force, FaceField<Real>& balance,
                       const CellField<SymTensor>& Bt, const CellField<Real>& alpha,
                       const FaceWeights& weights, const GradientStencil& stencil,
                       const Band& band) {
  for (const Index c : last_cells_) force[c] = {}, tau_[c] = {}, grad_[c] = {};
  for (const Index f : last_faces_) balance[f] = 0;
  last_cells_ = band.cells();
  last_faces_ = band.faces();

  for (const Index c : band.core())
    tau_[c] = (std::sqrt(std::max(alpha[c], 0.0)) * G_) * dev(Bt[c]);
  mesh_.halo.update(tau_);
  gradient(grad_, tau_, stencil, mesh_, band.cells());
  mesh_.halo.update(grad_);
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    if (f >= mesh_.n_internal) {
      force[P] += (1 / mesh_.V[P]) * dot(tau_[P], mesh_.Sf[f]);
      continue;
    }
    const Index N = mesh_.neighbour[f];
    const Real lambda = weights.lambda[f];
    const Vec3 t = dot((1 - lambda) * tau_[P] + lambda * tau_[N], mesh_.Sf[f]);
    force[P] += (1 / mesh_.V[P]) * t;
    force[N] -= (1 / mesh_.V[N]) * t;
    const Vec3 d = mesh_.d[f], n = d / norm(d);
    const auto normal_stress = [&](const SymTensor& a) { return dot(n, dot(a, n)); };
    const SymGradient &g_P = grad_[P], &g_N = grad_[N];
    const SymTensor slope = d.x * ((1 - lambda) * g_P.x + lambda * g_N.x) +
                            d.y * ((1 - lambda) * g_P.y + lambda * g_N.y) +
                            d.z * ((1 - lambda) * g_P.z + lambda * g_N.z);
    balance[f] = normal_stress(tau_[N] - tau_[P] - slope);
  }
  mesh_.halo.update(force);
}

Real elastic_dt(const CellField<SymTensor>& Bt, const CellField<Real>& alpha, Real G, Real rho,
                const Mesh& mesh, std::span<const Index> cells) {
  Real dt = std::numeric_limits<Real>::max();
  if (G <= 0) return dt;
  for (const Index c : cells) {
    Real area = 0;
    for (const Index f : mesh.cell_faces[c]) area = std::max(area, norm2(mesh.Sf[f]));
    const Real h = mesh.V[c] / std::sqrt(area),
               lambda = std::max(trace(B_of(Bt[c], alpha[c])), 1.0);
    dt = std::min(dt, 0.8 * h * std::sqrt(rho / (G * lambda)));
  }
  return dt;
}

SymTensor B_of(const SymTensor& Bt, Real alpha) {
  return alpha >= alpha_min ? (1 / std::sqrt(alpha)) * Bt : identity();
}

}  // namespace fsi::solid
