// The calls of a step for a solid with another density than the fluid.

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {

void Solver::mix_density() {
  const Profile::Call call(profile_, calls_.mix_density);
  if (!heavy_) return;
  flow::Density& density = heavy_->density;
  density.clear();
  for (const Body& body : bodies_)
    if (body.rho != physics_.rho)
      density.add(body.rho, body.alpha, body.alpha_f, body.band.faces());
  density.finish();
  projection_.set_density(density);
}

// Solved until all faces are at rest: sum_f (rho_0 / rho_f) (forces - compact grad p) . S = 0
void Solver::balance_weight(State& state) {
  const Profile::Call call(profile_, calls_.balance_weight);
  if (!heavy_) return;
  mesh_.halo.update(force_);
  if (state.step == 0) {
    constexpr int most = 60;
    constexpr Real round_off = 1e-15;
    flow::FluxTerms terms = flux_terms(0);
    terms.force = &force_;
    FaceField<Real> flux(mesh_);
    BoundaryField<Real> q_b(mesh_);
    Real first = 0;
    for (int i = 0; i < most; ++i) {
      flow::flux_of_rest(flux, momentum_.boundary().open, terms, weights_, mesh_);
      projection_.project(flux, q_, grad_q_, q_b, 0);
      Real largest = 0;
      for (Index c = 0; c < mesh_.n_cells; ++c) {
        state.p[c] += q_[c];
        largest = std::max(largest, std::abs(q_[c]));
      }
      set_pressure_gradient(grad_p_, state);
      largest = global_max(largest);
      if (i == 0) first = largest;
      if (largest <= round_off * first) break;
    }
  }
  const Vec3 uniform = driving_gradient() * axis_;
  for (Index c = 0; c < mesh_.n_cells; ++c) heavy_->force[c] = force_[c] + uniform - grad_p_[c];
}

void Solver::renew_responses() {
  if (!heavy_) return;
  if (forcing_) forcing_->renew(projection_, heavy_->density);
  loads_.renew(projection_);
}

}  // namespace fsi
