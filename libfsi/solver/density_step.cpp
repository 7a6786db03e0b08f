// The calls of a step for a solid with another density than the fluid, and the pressure that
// balances openings and forces at rest.

#include <algorithm>
#include <cmath>
#include <limits>

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
  if (!at_rest_) return;
  if (state.step == 0) {
    mesh_.halo.update(force_);
    add_pressure_of_rest(state, force_, rhie_chow_source_);
  } else if (state.step == begun()) {
    add_pressure_of_new_weight(state);
  }
}

// p = p_0 + q, Lap q = 0, q = p_b - p_0 at the openings: what they press with passes through the
// fluid at once. p_0, the largest of them, keeps the solver's tolerance to their differences.
void Solver::set_pressure_of_rest() {
  if (!projection_.open()) return;
  const std::vector<char>& open = momentum_.boundary().open;
  openings_.set_pressure(p_b_, state_.u);
  Real p_0 = -std::numeric_limits<Real>::max();
  for (Index b = 0; b < mesh_.n_boundary(); ++b)
    if (open[b] != 0) p_0 = std::max(p_0, p_b_[b]);
  p_0 = global_max(p_0);
  for (Index b = 0; b < mesh_.n_boundary(); ++b) q_b_[b] = open[b] != 0 ? p_b_[b] - p_0 : 0;
  FaceField<Real> flux(mesh_);
  projection_.project(flux, q_, grad_q_, q_b_, 0);
  for (Index c = 0; c < mesh_.n_cells; ++c) state_.p[c] = p_0 + q_[c];
  q_b_.fill(0);
}

// What is left of the force then tells how the flow begins. Call 14 balances the first step.
void Solver::add_pressure_of_body_force() {
  if (!driving_force_ || !at_rest_) return;
  CellField<Vec3>& force = at_rest_->weight;
  for (Index c = 0; c < mesh_.n_owned; ++c) force[c] = driving_force_(mesh_.C[c], state_.t);
  mesh_.halo.update(force);
  set_pressure_gradient(grad_p_, state_);
  add_pressure_of_rest(state_, force, at_rest_->source);
}

// The flow that is there has its own pressure, so what is new is balanced apart from it.
void Solver::add_pressure_of_new_weight(State& state) {
  at_rest_->weight.fill({});
  at_rest_->source.fill(0);
  bool none = true;
  for (Body& body : bodies_) {
    if (body.begun != state.step || !body.body_force) continue;
    none = false;
    add_weight(at_rest_->weight, at_rest_->source, body, projection_.stencil());
  }
  if (none) return;
  mesh_.halo.update(at_rest_->weight);
  add_pressure_of_rest(state, at_rest_->weight, at_rest_->source);
}

// The flux that the pressure makes on its own; 0 before the first step, whose force is the whole.
void Solver::set_flux_of_pressure(const State& state) {
  at_rest_->of_flow.fill(0);
  if (state.step == 0) return;
  flow::flux_of_rest(at_rest_->of_flow, {}, momentum_.boundary().open, flux_terms(0), weights_,
                     mesh_);
}

// p = p_0 + p', solved until the force leaves all faces at rest beside p', the change of p:
//   sum_f (rho_0 / rho_f) (force - compact grad p') . S = 0
// The changes fall until only their rounding is left.
void Solver::add_pressure_of_rest(State& state, const CellField<Vec3>& force,
                                  const FaceField<Real>& source) {
  constexpr int most = 60;
  constexpr Real round_off = 1e-15;
  FaceField<Real>& flux = at_rest_->flux;
  if (const auto& rest = projection_.oblique_rest()) at_rest_->oblique_rest.assign(*rest);
  set_flux_of_pressure(state);
  Real first = 0, last = std::numeric_limits<Real>::max();
  for (int i = 0; i < most; ++i) {
    flow::flux_of_rest(flux, {&force, &source}, momentum_.boundary().open, flux_terms(0), weights_,
                       mesh_);
    for (Index f = 0; f < mesh_.n_faces; ++f) flux[f] -= at_rest_->of_flow[f];
    projection_.project(flux, q_, grad_q_, at_rest_->q_b, 0);
    Real largest = 0;
    for (Index c = 0; c < mesh_.n_cells; ++c) {
      state.p[c] += q_[c];
      largest = std::max(largest, std::abs(q_[c]));
    }
    set_pressure_gradient(grad_p_, state);
    largest = global_max(largest);
    if (i == 0) first = largest;
    if (largest <= round_off * first || largest >= last) break;
    last = largest;
  }
  if (auto& rest = projection_.oblique_rest()) rest->assign(at_rest_->oblique_rest);  // of the flow
}

void Solver::renew_responses() {
  if (!heavy_) return;
  if (forcing_) forcing_->renew(projection_, heavy_->density);
  loads_.renew(projection_);
}

}  // namespace fsi
