#include "libfsi/flow/momentum.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi::flow {
namespace {

constexpr int damped_steps = 2;  // the first, with theta = 1

}  // namespace

void mixture_viscosity(FaceField<Real>& mu, const CellField<Real>& alpha, Real mu_f, Real mu_s,
                       const FaceWeights& weights, const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Real a_P = alpha[mesh.owner[f]], a_N = alpha[mesh.neighbour[f]];
    mu[f] = mu_f + (mu_s - mu_f) * (a_P + weights.lambda[f] * (a_N - a_P));
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
    mu[f] = mu_f + (mu_s - mu_f) * alpha[mesh.owner[f]];
}

void convection(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                const BoundaryField<Vec3>& u_b, const CellField<Tensor>& L,
                const FaceWeights& weights, const Mesh& mesh) {
  conv.fill({});
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Real lambda = weights.lambda[f];
    // u_f = (1 - lambda) u_P + lambda u_N + (grad u)_f . skew
    Vec3 u_f = u[P] + lambda * (u[N] - u[P]);
    if (weights.skewed)
      u_f += (1 - lambda) * dot(L[P], weights.skew[f]) + lambda * dot(L[N], weights.skew[f]);
    conv[P] += phi[f] * (u_f - u[P]);
    conv[N] -= phi[f] * (u_f - u[N]);
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f];
    conv[P] += phi[f] * (u_b[f - mesh.n_internal] - u[P]);
  }
}

void viscous_compact(CellField<Vec3>& visc, const FaceField<Real>& mu, const CellField<Vec3>& u,
                     const BoundaryField<Vec3>& u_b, const std::vector<char>& open_face,
                     const FaceWeights& weights, const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Vec3 flux = mu[f] * weights.g[f] * (u[N] - u[P]);
    visc[P] += flux;
    visc[N] -= flux;
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f], b = f - mesh.n_internal;
    if (open_face[b] == 0) visc[P] += mu[f] * weights.g[f] * (u_b[b] - u[P]);
  }
}

void viscous_rest(CellField<Vec3>& rest, const FaceField<Real>& mu, Real mu_0,
                  const CellField<Tensor>& L, const std::vector<char>& open_face,
                  const FaceWeights& weights, const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Real excess = mu[f] - mu_0;
    if (!weights.non_orthogonal && excess == 0) continue;
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Tensor L_f = (1 - weights.lambda[f]) * L[P] + weights.lambda[f] * L[N];
    const Vec3 flux = mu[f] * dot(L_f, weights.k[f]);
    rest[P] += flux;
    rest[N] -= flux;
    if (excess == 0) continue;
    rest[P] += excess * dot(transpose(L[P]), mesh.Sf[f]);
    rest[N] -= excess * dot(transpose(L[N]), mesh.Sf[f]);
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    if (open_face[f - mesh.n_internal] != 0) continue;
    const Index P = mesh.owner[f];
    rest[P] += mu[f] * dot(L[P], weights.k[f]) + (mu[f] - mu_0) * dot(transpose(L[P]), mesh.Sf[f]);
  }
}

Real courant_rate(const FaceField<Real>& phi, const Mesh& mesh, Index c) {
  Real sum = 0;
  for (const Index f : mesh.cell_faces[c]) sum += std::abs(phi[f]);
  return sum / (2 * mesh.V[c]);
}

std::array<Real, 3> adams_bashforth(Real dt, Real dt_old, Real dt_before, Real bend) {
  if (dt_old <= 0) return {1, 0, 0};
  // int over [0, dt] of the line through 0 and -a, and of what the parabola through -b adds to it,
  // q'' t (t + a) / 2, both divided by dt
  const Real a = dt_old, b = dt_old + dt_before, slope = dt / (2 * a);
  if (dt_before <= 0 || dt > 2 * dt_old || dt_old > 2 * dt_before) return {1 + slope, -slope, 0};
  const Real mean = bend * (dt * dt / 3 + a * dt / 2);
  return {1 + slope + mean / (a * b), -slope - mean / (a * (b - a)), mean / (b * (b - a))};
}

Momentum::Momentum(const Mesh& mesh, const FaceWeights& weights,
                   const std::vector<Condition>& conditions, Real rho, Real mu_0)
    : mesh_(mesh),
      weights_(weights),
      rho_(rho),
      mu_0_(mu_0),
      open_face_(static_cast<std::size_t>(mesh.n_boundary()), 0),
      history_{CellField<Vec3>(mesh), CellField<Vec3>(mesh), CellField<Vec3>(mesh)},
      rhs_(mesh),
      w_(static_cast<std::size_t>(mesh.n_cells * mesh.dim)),
      b_(static_cast<std::size_t>(mesh.n_owned * mesh.dim)),
      system_(mesh, "u", 1e-7) {
  implicit_.assign(open_face_.size(), Vec3{1, 1, 1});
  for (std::size_t i = 0; i < conditions.size(); ++i)
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Index b = f - mesh.n_internal;
      const Vec3 n = mesh.Sf[f] / norm(mesh.Sf[f]);
      if (fixes_pressure(conditions[i])) open_face_[b] = 1, implicit_[b] = {};
      if (std::holds_alternative<Slip>(conditions[i]))
        implicit_[b] = {n.x * n.x, n.y * n.y, n.z * n.z};
    }
  if (weights.non_orthogonal) expect(mu_0);
}

void Momentum::expect(Real mu_max) {
  has_rest_ = true;
  Real spread = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    Real sum = 0;
    for (const Index f : mesh_.cell_faces[c]) sum += weights_.g[f];
    spread = std::max(spread, sum / mesh_.V[c]);
  }
  rate_ = mu_max / rho_ * global_max(spread);
}

// In its stiffest cell u obeys u_t = -l (1 - r) u, l = spread mu / rho, where r l u is the explicit
// rest. With Adams-Bashforth the step z,
//   (1 + theta l dt) z^2 = (1 - (1 - theta) l dt + 3/2 r l dt) z - r l dt / 2,
// leaves the unit circle at z = -1, where theta < 1/2 - r - 1 / (l dt); with Euler's rule and
// theta = 1 it stays inside for |r| < 1.
Real Momentum::theta_at(Real dt) const {
  return rate_ > 0 ? std::max(theta, 1 - 1 / (rate_ * dt)) : theta;
}

Real Momentum::extrapolated(Real dt) const {
  return rate_ > 0 ? std::min(Real{1}, 2 / (rate_ * dt)) : 1;
}

void Momentum::assemble(const FaceField<Real>& mu, const FaceField<Real>& kappa, Real theta_now,
                        Real dt) {
  const Index dim = mesh_.dim;
  VectorMatrix& A = system_.matrix();
  for (Index c = 0; c < mesh_.n_owned; ++c)
    for (Index i = 0; i < dim; ++i) A.diagonal[c * dim + i] = rho_ * mesh_.V[c] / dt;
  const auto add = [&](Index c, const Vec3& a) {
    if (c >= mesh_.n_owned) return;
    for (Index i = 0; i < dim; ++i) A.diagonal[c * dim + i] += a[static_cast<int>(i)];
  };
  for (Index f = 0; f < mesh_.n_faces; ++f) {
    const Real a = (theta_now * mu[f] + kappa[f]) * weights_.g[f];
    if (f >= mesh_.n_internal) {
      add(mesh_.owner[f], a * implicit_[f - mesh_.n_internal]);
      continue;
    }
    A.off_diagonal[f] = -a;
    add(mesh_.owner[f], {a, a, a});
    add(mesh_.neighbour[f], {a, a, a});
  }
  system_.renewed();
  assembled_ = {theta_now, dt};
}

void Momentum::hold_past() { past_.emplace(CellField<Vec3>(mesh_), BoundaryField<Vec3>(mesh_)); }

// Central convection has imaginary eigenvalues, up to i Co. There the parabola is stable to 0.72,
// three quarters of it at 0.72 best (0.91), the line nowhere; with viscosity the line bears more.
Real Momentum::bend(const FaceField<Real>& phi, Real dt) const {
  constexpr Real whole = 0.66, none = 0.9;
  Real rate = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c) rate = std::max(rate, courant_rate(phi, mesh_, c));
  return std::clamp((none - global_max(rate) * dt) / (none - whole), Real{0}, Real{1});
}

// Histories are written in place: checkpoints and backups know their address.
void Momentum::add_convection(const FaceField<Real>& phi, const CellField<Vec3>& u,
                              const BoundaryField<Vec3>& u_b, const CellField<Tensor>& L, Real dt) {
  auto& [last, before, rest] = history_;
  const auto w = adams_bashforth(dt, dt_old, dt_before, bend(phi, dt));
  for (Index c = 0; c < mesh_.n_owned; ++c) rhs_[c] -= rho_ * (w[1] * last[c] + w[2] * before[c]);
  before.assign(last);
  convection(last, phi, u, u_b, L, weights_, mesh_);
  for (Index c = 0; c < mesh_.n_owned; ++c) rhs_[c] -= (rho_ * w[0]) * last[c];
}

void Momentum::add_rest(const FaceField<Real>& mu, const CellField<Tensor>& L, Real dt) {
  const auto w = adams_bashforth(dt, dt_old, 0, 0);
  const Real share = extrapolated(dt);
  CellField<Vec3>& rest = history_.rest;
  for (Index c = 0; c < mesh_.n_owned; ++c) rhs_[c] += w[1] * rest[c];
  rest.fill({});
  viscous_rest(rest, mu, mu_0_, L, open_face_, weights_, mesh_);
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    rhs_[c] += (1 - share + w[0] * share) * rest[c];
    rest[c] *= share;
  }
}

void Momentum::add_compact(const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                           const FaceField<Real>& mu, Real theta_now, Real dt) {
  if (!past_ || steps_taken < damped_steps) {
    viscous_compact(rhs_, mu, u, u_b, open_face_, weights_, mesh_);
  } else {
    const Real back = (theta_now - 0.5) * dt / dt_old;
    for (Index c = 0; c < mesh_.n_cells; ++c) past_->u[c] = u[c] - back * (u[c] - past_->u[c]);
    for (Index b = 0; b < mesh_.n_boundary(); ++b)
      past_->u_b[b] = u_b[b] - back * (u_b[b] - past_->u_b[b]);
    viscous_compact(rhs_, mu, past_->u, past_->u_b, open_face_, weights_, mesh_);
  }
  if (past_) past_->u.assign(u);
}

void Momentum::set_rhs(const BoundaryField<Vec3>& u_b, const BoundaryField<Vec3>& u_b_new,
                       const CellField<Vec3>& grad_p, const FaceField<Real>& mu,
                       const FaceField<Real>& kappa, const Sources& sources, Real theta_now) {
  for (Index c = 0; c < mesh_.n_owned; ++c)
    rhs_[c] += mesh_.V[c] * (sources.force[c] + sources.body - grad_p[c]);
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f) {
    const Index b = f - mesh_.n_internal;
    if (open_face_[b] == 0)
      rhs_[mesh_.owner[f]] +=
          (theta_now * mu[f] + kappa[f]) * weights_.g[f] * (u_b_new[b] - u_b[b]);
  }
}

int Momentum::predict(CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                      const BoundaryField<Vec3>& u_b_new, const CellField<Vec3>& grad_p,
                      const CellField<Tensor>& L, const FaceField<Real>& phi,
                      const FaceField<Real>& mu, const FaceField<Real>& kappa, bool mu_varies,
                      bool stiff, const Sources& sources, Real dt) {
  const Real theta_now = steps_taken < damped_steps ? 1.0 : theta_at(dt);
  if (mu_varies || stiff || assembled_ != std::array{theta_now, dt})
    assemble(mu, kappa, theta_now, dt);

  rhs_.fill({});
  add_convection(phi, u, u_b, L, dt);
  if (has_rest_) add_rest(mu, L, dt);
  add_compact(u, u_b, mu, theta_now, dt);
  set_rhs(u_b, u_b_new, grad_p, mu, kappa, sources, theta_now);

  const Index dim = mesh_.dim;
  const std::vector<Real>& diagonal = system_.matrix().diagonal;
  for (Index c = 0; c < mesh_.n_owned; ++c)
    for (Index i = c * dim; i < (c + 1) * dim; ++i) {
      b_[i] = rhs_[c][static_cast<int>(i - c * dim)];
      w_[i] = b_[i] / diagonal[i];
    }
  const int iterations = system_.solve(w_, b_).iterations;
  for (Index c = 0; c < mesh_.n_cells; ++c)
    for (Index i = 0; i < dim; ++i) u[c][static_cast<int>(i)] += w_[c * dim + i];
  dt_before = dt_old;
  dt_old = dt;
  ++steps_taken;
  return iterations;
}

}  // namespace fsi::flow
