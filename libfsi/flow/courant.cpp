#include "libfsi/flow/courant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::flow {
namespace {

constexpr Real central = 0.6;      // Adams-Bashforth of third order is stable to 0.72
constexpr Real upwind = 0.3;       // of second order
constexpr Real damped_part = 0.2;  // Adams-Bashforth of third order is stable with it and 0.6 i
constexpr Real tiny = 1e-30;       // a Courant number that counts as 0

}  // namespace

Courant::Courant(const Mesh& mesh, Convection scheme)
    : mesh_(mesh),
      scheme_(scheme),
      bound_(scheme == Convection::linear || scheme == Convection::symmetric ? central : upwind),
      volume_(mesh.points.size(), 0),
      over_(mesh),
      implicit_(mesh),
      at_edge_(mesh),
      swept_(mesh),
      at_vertex_(mesh.points.size(), 0) {
  bool none = true;
  for (Index c = 0; c < mesh.n_owned; ++c) none = none && !mesh.simplex(c);
  any_simplex_ = !all_of_ranks(none);
  if (!any_simplex_) return;
  fast_.reserve(mesh.n_owned);
  for (Index c = 0; c < mesh.n_cells; ++c)
    for (const Index p : mesh.cell_points[c]) volume_[mesh.vertex[p]] += mesh.V[c];
}

void Courant::sum_at_vertices() const {
  if (!any_simplex_) return;
  mesh_.halo.update(swept_);
  std::ranges::fill(at_vertex_, 0);
  for (Index c = 0; c < mesh_.n_cells; ++c)
    for (const Index p : mesh_.cell_points[c]) at_vertex_[mesh_.vertex[p]] += swept_[c];
}

Real Courant::of_cell(Index c) const {
  if (!mesh_.simplex(c)) return swept_[c] / mesh_.V[c];
  Real sum = 0, volume = 0;
  for (const Index p : mesh_.cell_points[c]) {
    sum += at_vertex_[mesh_.vertex[p]];
    volume += volume_[mesh_.vertex[p]];
  }
  return sum / volume;
}

Real Courant::rate(const FaceField<Real>& phi) const {
  for (Index c = 0; c < mesh_.n_owned; ++c) swept_[c] = courant_rate(phi, mesh_, c) * mesh_.V[c];
  sum_at_vertices();
  Real largest = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c) largest = std::max(largest, of_cell(c));
  return global_max(largest);
}

Real Courant::upwind_dt(const FaceField<Real>& phi, bool implicit_served) const {
  constexpr Real stable = 0.25;
  if (bound_ == central) return std::numeric_limits<Real>::max();
  Real rate = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c)
    if (!(implicit_served && mesh_.simplex(c))) rate = std::max(rate, courant_rate(phi, mesh_, c));
  rate = global_max(rate);
  return rate > 0 ? stable / rate : std::numeric_limits<Real>::max();
}

std::vector<Real> Courant::of_neighbourhood(const std::vector<Real>& swept) const {
  std::vector<Real> rate(swept.size());
  for (Index c = 0; c < mesh_.n_owned; ++c) swept_[c] = swept[c];
  sum_at_vertices();
  for (Index c = 0; c < mesh_.n_owned; ++c) rate[c] = of_cell(c);
  return rate;
}

// Let A be the skew convection of a step, k_f = a_f |phi_f| dt / 2 and s = iota_f. Then v*Av = i
// sum_f phi_f dt Im(v_P* v_N). A part s of it is at most s |phi_f| dt |v_P| |v_N - v_P|, and so
//   <= Co_0 k_f |v_N - v_P|^2 + s^2 |phi_f| dt / (2 Co_0 a_f) |v_P|^2.
// The rest is at most (1 - s) |phi_f| dt / 2 (|v_P|^2 + |v_N|^2). All of v*Av shall be below Co_0
// v*(V + K)v. So the faster cell N needs 1 - s <= Co_0 / Co_N, and the slower cell P needs 1 - s +
// s^2 / (Co_0 a_f) <= Co_0 / Co_P. The flux of a cell's boundary faces b damps it by sum_b |phi_b|
// dt / 2, and the upwind share by beta |phi_f| dt / 2 |v_N - v_P|^2. Both are explicit too, and
// shall be at most 0.2 of K.
void Courant::add_implicit(FaceField<Real>& kappa, const FaceField<Real>& phi, Real rho, Real dt,
                           const FaceWeights& weights) {
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    Real all = 0, inner = 0;
    for (const Index f : mesh_.cell_faces[c]) {
      all += std::abs(phi[f]);
      if (f < mesh_.n_internal) inner += std::abs(phi[f]);
    }
    over_[c] = 1 - bound_ * mesh_.V[c] / std::max(dt * all / 2, tiny * mesh_.V[c]);
    const bool can = mesh_.simplex(c) && inner > 0;
    implicit_[c] = can ? std::clamp(all / inner * over_[c], 0., 1.) : 0;
    at_edge_[c] = can ? implicit_[c] * (all / inner - 1) / damped_part : 0;
  }
  mesh_.halo.update(over_), mesh_.halo.update(implicit_), mesh_.halo.update(at_edge_);
  for (Index f = 0; f < mesh_.n_internal; ++f) {
    const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
    const Real asked = std::max(implicit_[P], implicit_[N]), q = std::min(over_[P], over_[N]);
    if (asked == 0) continue;
    const Real s = std::clamp(2 * q, asked, Real{1});
    const Real beta = scheme_ == Convection::symmetric ? 0
                      : scheme_ == Convection::linear  ? weights.damping(f, mesh_)
                                                       : 1;
    const Real a =
        std::max({s * s / (bound_ * (s - q)), s * beta / damped_part, at_edge_[P], at_edge_[N]});
    kappa[f] += a * rho * std::abs(phi[f]) / (2 * weights.g[f]);
  }
}

void Courant::share(CellField<Vec3>& change, const FaceField<Real>& kappa, Real dt_rho,
                    const FaceWeights& weights) {
  if (!any_simplex_) return;
  fast_.clear();
  for (Index c = 0; c < mesh_.n_owned; ++c)
    if (implicit_[c] > 0) fast_.emplace_back(c, mesh_.V[c] * change[c]);
  const auto renew = [&](const std::pair<Index, Vec3>& fast) {
    const Index c = fast.first;
    Vec3 sum = fast.second;
    Real all = mesh_.V[c];
    for (const Index f : mesh_.cell_faces[c]) {
      if (f >= mesh_.n_internal) continue;
      const Real k = kappa[f] * weights.g[f] * dt_rho;
      sum += k * change[mesh_.owner[f] == c ? mesh_.neighbour[f] : mesh_.owner[f]], all += k;
    }
    change[c] = sum / all;
  };
  if (all_of_ranks(fast_.empty())) return;
  constexpr int sweeps = 8;
  for (int k = 0; k < sweeps; ++k) {
    std::for_each(fast_.begin(), fast_.end(), renew);
    std::for_each(fast_.rbegin(), fast_.rend(), renew);
    mesh_.halo.update(change);
  }
}

}  // namespace fsi::flow
