#include "libfsi/solid/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libfsi/core/parallel.hpp"

namespace fsi::solid {

Real elastic_time(const CellField<Real>& lambda, Real G, Real rho, const Mesh& mesh,
                  std::span<const Index> cells) {
  Real time = std::numeric_limits<Real>::max();
  if (G <= 0) return time;
  for (const Index c : cells) {
    Real area = 0;
    for (const Index f : mesh.cell_faces[c]) area = std::max(area, norm2(mesh.Sf[f]));
    const Real h = mesh.V[c] / std::sqrt(area);
    time = std::min(time, h * std::sqrt(rho / (G * std::max(lambda[c], 1.0))));
  }
  return time;
}

Stiffness::Stiffness(const Mesh& mesh) : mesh_(mesh) {
  bool none = true;
  for (Index c = 0; c < mesh.n_owned; ++c)
    none = none && static_cast<int>(mesh.cell_faces[c].size()) > mesh.dim + 1;
  simplex_ = !all_of_ranks(none);
}

void Stiffness::apply(FaceField<Real>& kappa, CellField<Vec3>& force, const Stiffening& solid,
                      const FaceWeights& weights, const Band& band) {
  constexpr Real share = 0.3;
  const CellField<Real>& lambda = solid.lambda;
  for (const Index f : last_faces_) kappa[f] = 0;
  last_faces_ = band.faces();
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    Real l = lambda[P];
    if (f < mesh_.n_internal) l += weights.lambda[f] * (lambda[mesh_.neighbour[f]] - l);
    l *= solid.alpha[f];
    kappa[f] = share * solid.dt * solid.G * l;
    if (f >= mesh_.n_internal || l <= 0) continue;
    const Index N = mesh_.neighbour[f];
    if (lambda[P] == 0 || lambda[N] == 0) continue;  // beyond the band, where L is not known
    const Real d = norm(mesh_.d[f]);
    const Real wave = d * std::sqrt(solid.rho * solid.G * l);
    Real e = simplex_ ? 2 * wave : std::max(0.0, wave - solid.alpha[f] * solid.mu_s);
    if (simplex_) {
      kappa[f] += e;
    } else {
      // as much as stays stable beside k without an implicit part of its own
      e = std::min(e, 1.5 * (kappa[f] + solid.rho * d * d / (8 * solid.dt)));
    }
    // e g ((u_N - u_P) - (L_f . d))
    const Tensor L_f = (1 - weights.lambda[f]) * solid.L[P] + weights.lambda[f] * solid.L[N];
    const Vec3 flux = e * weights.g[f] * (solid.u[N] - solid.u[P] - dot(L_f, mesh_.d[f]));
    force[P] += (1 / mesh_.V[P]) * flux;
    force[N] -= (1 / mesh_.V[N]) * flux;
  }
  mesh_.halo.update(force);
}

}  // namespace fsi::solid
