#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "libfsi/core/clock.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/solver/diagnosis.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

/// Limits of the state after a step. They are wider than those by which the step was chosen, since
/// its final state is not known before.
constexpr Real courant_max = 1.2;           // transport crosses one cell in a step
constexpr Real carried_max = 1 + 1e-9;      // in the step of the solid: vof/advect.hpp
constexpr Real elastic_max = 1.2;           // of the elastic limit; beyond it waves grow
constexpr Real fraction_excess_max = 1e-8;  // of alpha over 1 or below 0
constexpr Real volume_change_max = 1e-4;    // of a cell, left over by the pressure solve

/// How many solids have left. The limits of such a solid are gone at once. A step of ten times the
/// last would extrapolate too far, and its pressure would be wrong.
std::ptrdiff_t bodies_gone(const std::deque<Body>& bodies) {
  return std::ranges::count_if(bodies, [](const Body& body) { return body.gone != 0; });
}

std::string failure_of(const State& state, Real least_dt) {
  return print("step %lld from t = %.6g failed down to dt = %.2g: ",
               static_cast<long long>(state.step + 1), state.t, least_dt);
}

/// Against what a step of dt leaves of the body; empty where there is nothing.
Rejection rejection_of(const Body& body, const Solver& solver, Real dt) {
  const std::string which = body.name.empty() ? "the solid" : "solid " + body.name;
  if (body.advected.courant > carried_max)
    return {which + " moved by more than a cell", Term::transport, &body};
  if (body.advected.remaining > fraction_excess_max)
    return {"the fraction of " + which + " left [0, 1]", Term::fraction, &body};
  if (!body.semi_implicit()) return {};
  if (dt > elastic_max * solver.elastic_dt(body))
    return {which + " became too stiff for the step", Term::elasticity, &body};
  if (dt > solver.strain_dt(solid::strain_max) || body.strain.of_part > solid::strain_max)
    return {which + " strains too much in the step", Term::strain, &body};
  if (global_min(body.eigenvalue_min) < eigenvalue_limit)
    return {"the smallest eigenvalue of B" + (body.name.empty() ? "" : " of " + which) +
                " fell below 1e-4",
            Term::eigenvalue, &body};
  return {};
}

}  // namespace

Rejection Solver::rejection_reason(Real dt) const {
  if (dt > advective_dt(courant_max))
    return {"the flow became too fast for the step", Term::convection};
  if (report_.pressure_residual * dt > volume_change_max * cells_norm_)
    return {"the flow is not divergence-free", Term::pressure};
  for (const Body& body : bodies_)
    if (Rejection of_body = rejection_of(body, *this, dt); !of_body.reason.empty()) return of_body;
  return {};
}

void Solver::check(const State& state) {
  const Profile::Call call(profile_, calls_.check);
  Real sum = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c) sum += norm2(state.u[c]) + state.p[c] * state.p[c];
  for (const Body& body : bodies_)
    for (const Index c : body.band.core()) sum += body.alpha[c] + trace(body.B[c]);
  if (!all_of_ranks(std::isfinite(sum)))
    throw Error(ErrorKind::numerics, "velocity, pressure or strain is not finite");
}

void Solver::hold_backup() {
  io::Snapshot state;
  list(state);
  backup_.emplace(state, mesh_);
}

void Solver::keep_backup() {
  if (!backup_) hold_backup();
  backup_->keep();
}

bool Solver::stuck(Real dt) {
  constexpr Real tiny = 1e-6;  // of the largest step
  constexpr int most = 100;    // such steps in a row; a single one may end at an event
  dt_largest_ = std::max(dt_largest_, dt);
  tiny_steps_ = dt < tiny * dt_largest_ ? tiny_steps_ + 1 : 0;
  return tiny_steps_ > most;
}

bool Solver::stands_apart() const {
  return std::ranges::any_of(bodies_, [&](const Body& body) { return body.t != state_.t; });
}

void Solver::synchronise() {
  if (!stands_apart()) return;
  for (Body& body : bodies_) hold_shape(body);
  for (Body& body : bodies_) advance_interface(body, state_.t);
  separate_bodies();
  for (const Body& body : bodies_) advect_pressure_jump(state_.p, body);
  set_pressure_gradient(grad_p_, state_);
  set_velocity_gradient(L_, state_);
  interface_faces_.clear();
  interface_L_f_.clear();
  for (Body& body : bodies_) transport_memory(body, L_);
  transport_elastic(L_);
  mix_density();
}

void Solver::at_one_time(const std::function<void()>& use) {
  if (!stands_apart()) return use();
  keep_backup();
  const auto take_back = [&] {
    backup_->restore();
    resume();
  };
  try {
    synchronise();
    use();
  } catch (const Error&) {
    take_back();
    throw;
  }
  take_back();
}

void Solver::require_step(Real dt) {
  require_length(dt);
  if (!balanced(state_.t + dt))
    throw Error(ErrorKind::numerics, std::exchange(report_.failure, ""));
}

void Solver::require_length(Real dt) const {
  require_bodies();
  if (dt > 0 && std::isfinite(dt)) return;  // the message is made in case of an error only
  throw Error(
      ErrorKind::input,
      print("a step of length dt = %g was asked for at t = %g: dt must be above 0 and finite", dt,
            state_.t));
}

// A shorter step would not help.
bool Solver::balanced(Real t) {
  if (!prescribed_) return true;
  set_boundary_velocity(u_b_new_, state_.u, conditions_, t, mesh_);
  const std::string excess = imbalance(passed_, u_b_new_, conditions_, mesh_);
  if (!excess.empty()) report_.failure = print("at t = %.6g ", t) + excess;
  return excess.empty();
}

Real Solver::advance(Real dt) {
  require_length(dt);
  if (!report_.failure.empty() && state_.step == failed_step_ && dt == failed_dt_)
    throw Error(ErrorKind::numerics, report_.failure);
  report_.failure.clear();
  failed_step_ = state_.step, failed_dt_ = dt;  // of no meaning but with a failure
  keep_backup();
  if (!balanced(state_.t + dt)) return 0;
  dt_cap_ = std::min(step_growth * dt_cap_, std::numeric_limits<Real>::max());
  report_.held_back = dt > dt_cap_;
  dt = std::min(dt, dt_cap_);
  constexpr int halvings = 8;
  const std::ptrdiff_t gone = bodies_gone(bodies_);
  std::string reason;
  for (int i = 0; i <= halvings; ++i, dt /= 2) {
    Rejection against;
    try {
      step(dt);
      against = rejection_reason(dt);
      if (against.reason.empty() && stuck(dt)) against = holder(*this, dt), i = halvings;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerics) throw;
      against = {error.what(), Term::solve, nullptr};
    }
    if (against.reason.empty()) {
      report_.held_back = report_.held_back || i > 0;
      if (i > 0 || bodies_gone(bodies_) > gone) dt_cap_ = dt;
      return dt;
    }
    reason = against.reason;
    if (i == halvings) reason += "; " + diagnosis(against, dt);
    backup_->restore();
    resume();
    ++report_.rejected;
    ++report_.rejections[against.reason];
  }
  report_.failure = failure_of(state_, 2 * dt) + reason;
  return 0;
}

}  // namespace fsi
