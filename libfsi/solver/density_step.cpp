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

void Solver::balance_weight(State& state) {
  const Profile::Call call(profile_, calls_.balance_weight);
  if (!heavy_) return;
  if (state.step == 0) {
    mesh_.halo.update(force_);
    add_pressure_of_rest(state, force_, rhie_chow_source_);
  } else if (state.step == begun()) {
    add_pressure_of_new_weight(state);
  }
}

// The flow that is there has its own pressure, so what is new is balanced apart from it.
void Solver::add_pressure_of_new_weight(State& state) {
  CellField<Vec3> weight(mesh_);
  FaceField<Real> source(mesh_);
  bool none = true;
  for (Body& body : bodies_) {
    if (body.begun != state.step || !body.body_force) continue;
    none = false;
    add_weight(weight, source, body, projection_.stencil());
  }
  if (none) return;
  mesh_.halo.update(weight);
  add_pressure_of_rest(state, weight, source);
}

// p = p_0 + p', solved until the force leaves all faces at rest beside p', the change of p:
//   sum_f (rho_0 / rho_f) (force - compact grad p') . S = 0
void Solver::add_pressure_of_rest(State& state, const CellField<Vec3>& force,
                                  const FaceField<Real>& source) {
  constexpr int most = 60;
  constexpr Real round_off = 1e-15;
  const std::vector<char>& open = momentum_.boundary().open;
  FaceField<Real> flux(mesh_), of_flow(mesh_), oblique_rest(mesh_);
  if (const auto& rest = projection_.oblique_rest()) oblique_rest.assign(*rest);
  if (state.step > 0) {
    const CellField<Vec3> none(mesh_);
    const FaceField<Real> nothing(mesh_);
    flow::flux_of_rest(of_flow, {none, nothing}, open, flux_terms(0), weights_, mesh_);
  }
  BoundaryField<Real> q_b(mesh_);
  Real first = 0;
  for (int i = 0; i < most; ++i) {
    flow::flux_of_rest(flux, {force, source}, open, flux_terms(0), weights_, mesh_);
    for (Index f = 0; f < mesh_.n_faces; ++f) flux[f] -= of_flow[f];
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
  if (auto& rest = projection_.oblique_rest()) rest->assign(oblique_rest);  // of the flow
}

void Solver::renew_responses() {
  if (!heavy_) return;
  if (forcing_) forcing_->renew(projection_, heavy_->density);
  loads_.renew(projection_);
}

}  // namespace fsi
