#include "libfsi/flow/momentum.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::flow {
namespace {

constexpr int damped_steps = 2;  // the first, with theta = 1

/// The least of the first dim components.
Real least(const Vec3& v, Index dim) {
  const Real xy = std::min(v.x, v.y);
  return dim == 2 ? xy : std::min(xy, v.z);
}

}  // namespace

Real reach(Real dt, Real dt_old) {
  constexpr Real most = 2;
  return std::min(dt, most * dt_old);
}

std::array<Real, 3> adams_bashforth(Real dt, Real dt_old, Real dt_before, Real ab3_weight) {
  if (dt_old <= 0) return {1, 0, 0};
  // int over [0, dt] of the line through 0 and -a, and of what the parabola through -b adds to it,
  // q'' t (t + a) / 2, both divided by dt
  const Real a = dt_old, b = dt_old + dt_before, slope = reach(dt, a) / (2 * a);
  if (dt_before <= 0 || dt > 2 * dt_old || dt_old > 2 * dt_before) return {1 + slope, -slope, 0};
  const Real mean = ab3_weight * (dt * dt / 3 + a * dt / 2);
  return {1 + slope + mean / (a * b), -slope - mean / (a * (b - a)), mean / (b * (b - a))};
}

Momentum::Momentum(const Mesh& mesh, const FaceWeights& weights,
                   const std::vector<Condition>& conditions, Real rho, Real mu_0, Convection scheme)
    : mesh_(mesh),
      weights_(weights),
      rho_(rho),
      mu_0_(mu_0),
      scheme_(scheme),
      boundary_{faces_where(conditions, mesh, fixes_pressure),
                faces_where(conditions, mesh, prescribes_flow)},
      history_{CellField<Vec3>(mesh), CellField<Vec3>(mesh), CellField<Vec3>(mesh)},
      theta_f_(mesh),
      rhs_(mesh),
      w_(static_cast<std::size_t>(mesh.n_cells * mesh.dim)),
      b_(static_cast<std::size_t>(mesh.n_owned * mesh.dim)),
      system_(mesh, "u", 1e-7) {
  implicit_.assign(boundary_.open.size(), Vec3{1, 1, 1});
  slips_ = faces_where(conditions, mesh, lets_slip);
  for (std::size_t i = 0; i < conditions.size(); ++i)
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Index b = f - mesh.n_internal;
      const Vec3 n = mesh.normal(f);
      if (fixes_pressure(conditions[i])) implicit_[b] = {};
      if (!lets_slip(conditions[i])) continue;
      implicit_[b] = {n.x * n.x, n.y * n.y, n.z * n.z};
      const bool oblique = std::abs(n.x * n.y) + std::abs(n.y * n.z) + std::abs(n.z * n.x) > 0;
      if (!oblique || mesh.owner[f] >= mesh.n_owned) continue;
      system_.matrix().couplings.push_back({mesh.owner[f], n, 0});
      coupled_.push_back(f);
    }
  if (weights.uneven) old_ = Old{CellField<Vec3>(mesh_), BoundaryField<Vec3>(mesh_)};
  set_theta(1);
}

bool Momentum::mirrored(Index f) const {
  return f >= mesh_.n_internal && slips_[f - mesh_.n_internal] != 0;
}

Real Momentum::between_cells(Index f) const {
  return mirrored(f) ? weights_.g[f] / 2 : weights_.g[f];
}

void Momentum::bound_explicit_viscosity(Real mu_max, Real theta_max) {
  Real spread = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    Real sum = 0;
    for (const Index f : mesh_.cell_faces[c]) sum += between_cells(f);
    spread = std::max(spread, sum / mesh_.V[c]);
  }
  rate_ = std::max(rate_, mu_max / rho_ * global_max(spread));
  theta_max_ = std::max(theta_max_, theta_max);
}

// In its stiffest cell u obeys u_t = -l (1 - r) u, l = spread mu / rho, where r l u is the explicit
// rest. With Adams-Bashforth the step z,
//   (1 + theta l dt) z^2 = (1 - (1 - theta) l dt + 3/2 r l dt) z - r l dt / 2,
// leaves the unit circle at z = -1, where theta < 1/2 - r - 1 / (l dt); with Euler's rule and
// theta = 1 it stays inside for |r| < 1. The excess of flat walls is a smaller part of l. For it a
// theta of 3/4 is enough (doc/notebook/2026-11-27-flat-walls.md).
Real Momentum::theta_at(Real dt) const {
  return rate_ > 0 ? std::max(theta, theta_max_ - (2 * theta_max_ - 1) / (rate_ * dt)) : theta;
}

Real Momentum::extrapolated(Real dt) const {
  return rate_ > 0 ? std::min(Real{1}, 2 / (rate_ * dt)) : 1;
}

void Momentum::set_theta(Real theta_now) {
  theta_f_.fill(theta_now);
  for (const Index f : weights_.irregular) theta_f_[f] = theta_of(f, theta_now);
}

Real Momentum::theta_of(Index f, Real theta_now) const {
  if (f >= mesh_.n_internal && boundary_.varied[f - mesh_.n_internal] == 0) return theta_now;
  return std::max(theta_now, weights_.implicit(f, mesh_));
}

void Momentum::raise_theta(const MomentumTerms& terms, Real theta_now, Real dt) {
  constexpr Real margin = 0.25;  // five times what a disc between sliding plates needs
  for (const Index f : raised_) theta_f_[f] = theta_of(f, theta_now);
  raised_.clear();
  for (const Index f : terms.one_sided) {
    const bool internal = f < mesh_.n_internal;
    if (!internal && !mirrored(f)) continue;
    const Index P = mesh_.owner[f], N = internal ? mesh_.neighbour[f] : P;
    const Real rho =
        terms.rho ? std::min(least((*terms.rho)[P], mesh_.dim), least((*terms.rho)[N], mesh_.dim))
                  : rho_;
    const Real l = dt * terms.mu[f] * between_cells(f) * (1 / mesh_.V[P] + 1 / mesh_.V[N]) / rho;
    if (margin * l <= 1) continue;
    theta_f_[f] = theta_of(f, theta_now) + margin - 1 / l;
    raised_.push_back(f);
  }
}

void Momentum::assemble(const MomentumTerms& terms, Real dt) {
  const Index dim = mesh_.dim;
  VectorMatrix& A = system_.matrix();
  for (Index c = 0; c < mesh_.n_owned; ++c)
    for (Index i = 0; i < dim; ++i) {
      const Real rho = terms.rho ? (*terms.rho)[c][static_cast<int>(i)] : rho_;
      A.diagonal[c * dim + i] = rho * mesh_.V[c] / dt;
    }
  const auto add = [&](Index c, const Vec3& a) {
    if (c >= mesh_.n_owned) return;
    for (Index i = 0; i < dim; ++i) A.diagonal[c * dim + i] += a[static_cast<int>(i)];
  };
  for (Index f = 0; f < mesh_.n_faces; ++f) {
    const Real a = (theta_f_[f] * terms.mu[f] + terms.kappa[f]) * weights_.g[f];
    add(mesh_.owner[f], f < mesh_.n_internal ? Vec3{a, a, a} : a * implicit_[f - mesh_.n_internal]);
    if (f >= mesh_.n_internal) continue;
    A.off_diagonal[f] = -a;
    add(mesh_.neighbour[f], {a, a, a});
  }
  for (std::size_t i = 0; i < coupled_.size(); ++i) {
    const Index f = coupled_[i];
    A.couplings[i].a = (theta_f_[f] * terms.mu[f] + terms.kappa[f]) * weights_.g[f];
  }
  system_.renewed();
}

void Momentum::hold_old() {
  if (whole_past_) return;
  whole_past_ = true;
  steps_taken = 0;  // the velocity before the last step may not be known
  hold_old_of_part();
}

void Momentum::hold_old_of_part() {
  if (!old_) old_ = Old{CellField<Vec3>(mesh_), BoundaryField<Vec3>(mesh_)};
}

// Central convection has imaginary eigenvalues, up to i Co. There AB3 is stable to 0.72, a blend of
// three quarters AB3 and one quarter AB2 to 0.78, AB2 nowhere. Viscosity lets AB2 bear more.
// A step multiplies a mode of the eigenvalue i z / dt by 1 + (1/4 - 5/8 w) z^4, w the weight of
// AB3. Symmetric convection has no others: with w = 3/4 it stays stable longest and loses less
// energy.
Real Momentum::ab3_weight(const MomentumTerms& terms, Real dt) {
  constexpr Real whole = 0.66, none = 0.9;
  const Real most = scheme_ == Convection::symmetric ? 0.75 : 1;
  Real part = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    const Real courant = dt * courant_rate(terms.phi, mesh_, c);
    part = std::max(part, mesh_.simplex(c) ? std::min(courant, terms.explicit_courant) : courant);
  }
  courant_ = global_max(part);
  return std::clamp((none - courant_) / (none - whole), Real{0}, most);
}

// Histories are written in place: checkpoints and backups know their address.
void Momentum::add_convection(const CellField<Vec3>& u, const MomentumTerms& terms, Real dt) {
  auto& [last, before, rest] = history_;
  const auto w = adams_bashforth(dt, dt_old, dt_before, ab3_weight(terms, dt));
  const auto subtract = [&](Index c, const Vec3& rate) {
    if (!terms.rho) return void(rhs_[c] -= rho_ * rate);
    const Vec3& rho = (*terms.rho)[c];
    rhs_[c] -= Vec3{rho.x * rate.x, rho.y * rate.y, rho.z * rate.z};
  };
  for (Index c = 0; c < mesh_.n_owned; ++c) subtract(c, w[1] * last[c] + w[2] * before[c]);
  before.assign(last);
  if (reads_L())
    convection_upwind(last, terms.phi, u, terms.u_b, terms.L, terms.L_f, weights_, mesh_,
                      scheme_ == Convection::limited);
  else
    convection(last, terms.phi, u, terms.u_b, terms.L_f, weights_, mesh_,
               scheme_ == Convection::symmetric);
  if (terms.kinks != nullptr && scheme_ == Convection::linear)
    add_kinks(last, terms.phi, *terms.kinks, mesh_);
  for (Index c = 0; c < mesh_.n_owned; ++c)
    if (terms.rho)
      subtract(c, w[0] * last[c]);
    else
      rhs_[c] -= (rho_ * w[0]) * last[c];
}

void Momentum::add_rest(const CellField<Vec3>& u, const MomentumTerms& terms, Real dt) {
  if (!weights_.uneven && !terms.mu_varies && terms.parabola == nullptr) return;
  const auto w = adams_bashforth(dt, dt_old, 0, 0);
  const Real share = extrapolated(dt);
  CellField<Vec3>& rest = history_.rest;
  for (Index c = 0; c < mesh_.n_owned; ++c) rhs_[c] += (share * w[1]) * rest[c];
  rest.fill({});
  viscous_oblique(rest, terms.mu, terms.L_f, boundary_, weights_, mesh_);
  if (terms.parabola != nullptr) terms.parabola->add_excess(rest, terms.mu, u, terms.u_b);
  if (terms.mu_varies) viscous_transposed(rest, terms.mu, mu_0_, terms.L, boundary_, mesh_);
  for (Index c = 0; c < mesh_.n_owned; ++c) rhs_[c] += (1 - share + share * w[0]) * rest[c];
}

void Momentum::add_compact(const CellField<Vec3>& u, const MomentumTerms& terms, Real dt) {
  viscous_compact(rhs_, terms.mu, u, terms.u_b, boundary_, weights_, mesh_);
  if (!old_) return;
  if (steps_taken >= damped_steps && (whole_past_ || theta_max_ < 1 || theta_at(dt) == 0.5))
    viscous_past(rhs_, terms.mu, theta_f_, reach(dt, dt_old) / dt_old, u, terms.u_b, old_->u,
                 old_->u_b, boundary_, weights_, mesh_);
  old_->u.assign(u);
}

void Momentum::add_sources(const MomentumTerms& terms) {
  for (Index c = 0; c < mesh_.n_owned; ++c)
    rhs_[c] += mesh_.V[c] * (terms.force[c] + terms.body - terms.grad_p[c]);
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f) {
    const Index b = f - mesh_.n_internal;
    if (boundary_.open[b] == 0)
      rhs_[mesh_.owner[f]] += (theta_f_[f] * terms.mu[f] + terms.kappa[f]) * weights_.g[f] *
                              (terms.u_b_new[b] - terms.u_b[b]);
  }
}

// a = (u* - u^n)/dt + AB3(conv)/V, of which rhs_ has the second part
void Momentum::set_convective(CellField<Vec3>& a, const CellField<Vec3>& rho) const {
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    const Vec3 part = (-1 / mesh_.V[c]) * rhs_[c];
    a[c] = {part.x / rho[c].x, part.y / rho[c].y, part.z / rho[c].z};
  }
}

void Momentum::add_change(CellField<Vec3>& a, Real dt) const {
  const Index dim = mesh_.dim;
  for (Index c = 0; c < mesh_.n_owned; ++c)
    for (Index i = 0; i < dim; ++i) a[c][static_cast<int>(i)] += w_[c * dim + i] / dt;
  mesh_.halo.update(a);
}

int Momentum::predict(CellField<Vec3>& u, const MomentumTerms& terms, Real dt) {
  const std::array now{steps_taken < damped_steps ? 1.0 : theta_at(dt), dt};
  if (assembled_[0] != now[0]) set_theta(now[0]);
  raise_theta(terms, now[0], dt);
  if (terms.mu_varies || terms.stiff || terms.rho || assembled_ != now) assemble(terms, dt);
  assembled_ = now;

  rhs_.fill({});
  add_convection(u, terms, dt);
  if (terms.acceleration != nullptr) set_convective(*terms.acceleration, *terms.rho);
  add_rest(u, terms, dt);
  add_compact(u, terms, dt);
  add_sources(terms);

  const Index dim = mesh_.dim;
  const std::vector<Real>& diagonal = system_.matrix().diagonal;
  for (Index c = 0; c < mesh_.n_owned; ++c)
    for (Index i = c * dim; i < (c + 1) * dim; ++i) {
      b_[i] = rhs_[c][static_cast<int>(i - c * dim)];
      w_[i] = b_[i] / diagonal[i];
    }
  const int iterations = system_.solve(w_, b_).iterations;
  if (terms.acceleration != nullptr) add_change(*terms.acceleration, dt);
  for (Index c = 0; c < mesh_.n_cells; ++c)
    for (Index i = 0; i < dim; ++i) u[c][static_cast<int>(i)] += w_[c * dim + i];
  dt_before = dt_old;
  dt_old = dt;
  ++steps_taken;
  return iterations;
}

}  // namespace fsi::flow
