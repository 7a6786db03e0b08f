#include "libfsi/flow/loads.hpp"

#include <cmath>
#include <utility>

namespace fsi::flow {

Loads::Loads(const Mesh& mesh, Projection& projection, Openings& openings, Real rho)
    : mesh_(mesh), rho_(rho), q_b_(mesh) {
  for (Openings::One& opening : openings.all()) {
    if (!opening.load.any()) continue;
    responses_.emplace_back(&opening, FaceField<Real>(mesh), CellField<Real>(mesh),
                            CellField<Vec3>(mesh));
  }
  const std::size_t n = responses_.size();
  S_.resize(n * n), A_.resize(n * n), pi_.resize(n), flow_.resize(n), sums_.resize(n);
  lines_.resize(n);
  renew(projection);
}

void Loads::renew(Projection& projection) {
  const std::size_t n = responses_.size();
  for (Response& r : responses_) {
    const Patch& patch = r.opening->patch;
    q_b_.fill(0);
    for (Index f = patch.begin; f < patch.end; ++f) q_b_[f - mesh_.n_internal] = 1;
    r.phi.fill(0);
    projection.project(r.phi, r.q, r.grad_q, q_b_, 0);
  }
  for (std::size_t k = 0; k < n; ++k) {
    set_flow_rates(responses_[k].phi);
    for (std::size_t j = 0; j < n; ++j) S_[j * n + k] = flow_[j];
  }
}

void Loads::set_flow_rates(const FaceField<Real>& phi) {
  for (std::size_t j = 0; j < responses_.size(); ++j) {
    sums_[j] = {};
    const Patch& patch = responses_[j].opening->patch;
    for (Index f = patch.begin; f < patch.end; ++f) sums_[j].add(phi[f]);
  }
  Sum::totals(flow_, sums_);
}

// With x = dt / (2 R_d C):  p_c(mid) = (p_c^n + dt / (2 C) Q) / (1 + x)
Loads::Line Loads::line(const Openings::One& opening, Real t, Real dt) {
  const Load& load = opening.load;
  const Real far = opening.given(t);
  if (load.capacitance == 0) return {far, load.proximal + load.distal};
  const Real half = dt / (2 * load.capacitance), x = half / load.distal;
  return {far + opening.stored / (1 + x), load.proximal + half / (1 + x)};
}

/// pi = A^-1 pi by elimination with pivots.
void Loads::solve() {
  const std::size_t n = pi_.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(A_[i * n + k]) > std::abs(A_[pivot * n + k])) pivot = i;
    for (std::size_t j = 0; j < n; ++j) std::swap(A_[k * n + j], A_[pivot * n + j]);
    std::swap(pi_[k], pi_[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Real factor = A_[i * n + k] / A_[k * n + k];
      for (std::size_t j = k; j < n; ++j) A_[i * n + j] -= factor * A_[k * n + j];
      pi_[i] -= factor * pi_[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) pi_[k] -= A_[k * n + j] * pi_[j];
    pi_[k] /= A_[k * n + k];
  }
}

// p_held + rho / dt pi_j = a_j + b_j (Q_j* + sum_k Y_jk pi_k - trend_over trend_j / 2)
void Loads::answer(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q, Real t,
                   Real dt, Real trend_over) {
  const std::size_t n = responses_.size();
  if (n == 0) return;
  set_flow_rates(phi);
  for (std::size_t j = 0; j < n; ++j) {
    const Openings::One& opening = *responses_[j].opening;
    lines_[j] = line(opening, t, dt);
    pi_[j] =
        lines_[j].a + lines_[j].b * (flow_[j] - trend_over * opening.trend / 2) - opening.pressure;
    for (std::size_t k = 0; k < n; ++k)
      A_[j * n + k] = (j == k ? rho_ / dt : 0) - lines_[j].b * S_[j * n + k];
  }
  solve();
  for (std::size_t k = 0; k < n; ++k) {
    const Response& r = responses_[k];
    for (Index f = 0; f < mesh_.n_faces; ++f) phi[f] += pi_[k] * r.phi[f];
    for (Index c = 0; c < mesh_.n_cells; ++c) {
      q[c] += pi_[k] * r.q[c];
      grad_q[c] += pi_[k] * r.grad_q[c];
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    Openings::One& opening = *responses_[j].opening;
    Real Q = flow_[j];
    for (std::size_t k = 0; k < n; ++k) Q += S_[j * n + k] * pi_[k];
    const Real Q_mid = Q - trend_over * opening.trend / 2;
    opening.pressure += rho_ / dt * pi_[j];
    const Load& load = opening.load;
    if (load.capacitance > 0) {
      const Real stored_mid = opening.pressure - opening.given(t) - load.proximal * Q_mid;
      opening.stored = 2 * stored_mid - opening.stored;
    }
    opening.trend = opening.flow_known ? (Q - opening.flow) / dt : 0;
    opening.flow = Q, opening.flow_known = 1;
  }
}

}  // namespace fsi::flow
