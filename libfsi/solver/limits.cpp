// Queries of a Solver on its state: limits of the step, pressures at openings, gradients.

#include <algorithm>
#include <cmath>
#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {

Real Solver::courant_rate_max(const FaceField<Real>& phi) const {
  if (modes_.implicit_convection) return courant_.rate(phi);
  Real rate = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c) rate = std::max(rate, courant_rate(phi, mesh_, c));
  return global_max(rate);
}

std::vector<Real> Solver::courant_rates() const {
  std::vector<Real> own(static_cast<std::size_t>(mesh_.n_owned));
  for (Index c = 0; c < mesh_.n_owned; ++c) own[c] = courant_rate(state_.phi, mesh_, c);
  if (!modes_.implicit_convection) return own;
  std::vector<Real> swept = own;
  for (Index c = 0; c < mesh_.n_owned; ++c) swept[c] *= mesh_.V[c];
  return courant_.of_neighbourhood(swept);
}

Real Solver::advective_dt(Real courant) const {
  const Real rate = courant_rate_max(state_.phi);
  return rate > 0 ? courant / rate : std::numeric_limits<Real>::max();
}

Real Solver::carried_dt() const {
  Real least = std::numeric_limits<Real>::max();
  for (const Body& body : bodies_) {
    Real rate = 0;
    for (const Index c : body.band.cells())
      rate = std::max(rate, courant_rate(state_.phi, mesh_, c));
    rate = global_max(rate);
    // body.t + body.dt = t + time_offset dt. That alone would let long and short steps alternate.
    if (rate > 0)
      least = std::min({least, 1 / rate, (1 / rate - (state_.t - body.t)) / body.time_offset()});
    if (rate > 0 && body.traction) least = std::min(least, body.traction->courant_max() / rate);
  }
  return least;
}

Real Solver::conditions_dt(Real end) const {
  Real dt = fsi::conditions_dt(conditions_, state_.t, end);
  for (const OfPlaceAndTime& given : over_time_) dt = std::min(dt, given.step_of(state_.t, end));
  return dt;
}

Real Solver::boundary_dt(Real courant) const {
  Real rate = 0;
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f)
    rate = std::max(rate,
                    norm(u_b_[f - mesh_.n_internal]) * norm(mesh_.Sf[f]) / mesh_.V[mesh_.owner[f]]);
  rate = global_max(rate);
  return rate > 0 ? courant / rate : std::numeric_limits<Real>::max();
}

// R: the Courant number per time of the flux a_f = (Phi(f) - g (p_N - p_P)) / rho
Real Solver::acceleration_rate() const {
  if (flow::size(state_.phi, mesh_) > 0) return 0;
  FaceField<Real> a(mesh_);
  for (Index f = 0; f < mesh_.n_internal; ++f) {
    const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
    const Real lambda = weights_.lambda[f];
    a[f] = -weights_.g[f] * (state_.p[N] - state_.p[P]) / physics_.rho;
    if (driving_force_)
      a[f] += dot(lambda * driving_force_(mesh_.C[P], state_.t) +
                      (1 - lambda) * driving_force_(mesh_.C[N], state_.t),
                  mesh_.Sf[f]) /
              physics_.rho;
  }
  return courant_rate_max(a);
}

// n steps of dt bring the Courant number to n dt^2 R.
Real Solver::acceleration_dt(Real courant, int steps) const {
  return start_rate_ > 0 ? std::sqrt(courant / (steps * start_rate_))
                         : std::numeric_limits<Real>::max();
}

Real Solver::elastic_dt(const Body& body) const {
  // A solid of another density than the fluid oscillates more at the limit.
  constexpr Real two_densities = 0.75;
  const Real part = body.rho != physics_.rho ? two_densities : 1;
  return part * body.elastic_number() *
         global_min(
             solid::elastic_time(body.lambda, body.G, body.rho, body.wave_width, body.band.core()));
}

Real Solver::elastic_dt() const {
  Real least = std::numeric_limits<Real>::max();
  for (const Body& body : bodies_) least = std::min(least, elastic_dt(body));
  return least;
}

Real Solver::strain_dt(Real strain) const {
  Real rate = 0;
  for (const Body& body : bodies_) rate = std::max(rate, body.strain.rate);
  return rate > 0 ? strain / rate : std::numeric_limits<Real>::max();
}

Real Solver::opening_pressure(const std::string& patch) const {
  for (const flow::Openings::One& opening : openings_.all())
    if (opening.patch.name == patch) return opening.pressure;
  throw Error(ErrorKind::input, "patch \"" + patch + "\" is no opening");
}

const CellField<Tensor>& Solver::velocity_gradient() {
  set_boundary_velocity(u_b_, state_.u, conditions_, state_.t, mesh_);
  gradient(L_, state_.u, u_b_, u_stencil_, mesh_);
  return L_;
}

}  // namespace fsi
