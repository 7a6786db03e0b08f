#include "libfsi/flow/courant.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::flow {
namespace {

constexpr Real central = 0.6;  // Adams-Bashforth of third order bears 0.72
constexpr Real upwind = 0.3;   // of second order

}  // namespace

Courant::Courant(const Mesh& mesh, Convection scheme)
    : mesh_(mesh),
      bound_(scheme == Convection::linear || scheme == Convection::symmetric ? central : upwind),
      volume_(mesh.points.size(), 0),
      courant_(mesh),
      swept_(mesh),
      at_vertex_(mesh.points.size(), 0) {
  bool none = true;
  for (Index c = 0; c < mesh.n_owned; ++c) none = none && !mesh.simplex(c);
  any_simplex_ = !all_of_ranks(none);
  if (!any_simplex_) return;
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

std::vector<Real> Courant::of_neighbourhood(const std::vector<Real>& swept) const {
  std::vector<Real> rate(swept.size());
  for (Index c = 0; c < mesh_.n_owned; ++c) swept_[c] = swept[c];
  sum_at_vertices();
  for (Index c = 0; c < mesh_.n_owned; ++c) rate[c] = of_cell(c);
  return rate;
}

// Why the larger of two cells counts for what cells alike need: A is the skew convection of a step,
// v*Av = i sum_f phi_f dt Im(v_P* v_N). That is at most sum_f |phi_f| dt |v_P| |v_N - v_P|, where P
// may be the larger one.
void Courant::add_implicit(FaceField<Real>& kappa, const FaceField<Real>& phi, Real rho, Real dt,
                           const FaceWeights& weights) {
  const Real C = bound_;
  for (Index c = 0; c < mesh_.n_owned; ++c)
    courant_[c] = mesh_.simplex(c) ? dt * courant_rate(phi, mesh_, c) / C : 0;
  mesh_.halo.update(courant_);
  for (Index f = 0; f < mesh_.n_internal; ++f) {
    const auto [less, most] = std::minmax(courant_[mesh_.owner[f]], courant_[mesh_.neighbour[f]]);
    if (most <= 1) continue;
    const Real alone = (1 - 1 / most) / C;
    const Real among_such = less > 1 ? (less - 1 / less) / (2 * C) : 0;
    kappa[f] += std::max(alone, among_such) * rho * std::abs(phi[f]) / (2 * weights.g[f]);
  }
}

}  // namespace fsi::flow
