#include "libfsi/flow/bulk_friction.hpp"

#include <algorithm>
#include <variant>

#include "libfsi/core/parallel.hpp"

namespace fsi::flow {

BulkFriction::BulkFriction(const Mesh& mesh, Projection& projection, Openings& openings) {
  FaceField<Real> flux(mesh);
  CellField<Vec3> grad(mesh);
  BoundaryField<Real> q_b(mesh);
  for (const Openings::One& opening : openings.all()) {
    Changing& one = changing_.emplace_back(&opening, CellField<Real>(mesh));
    if (openings.all().size() == 1) {
      one.share.fill(1);
      continue;
    }
    q_b.fill(0), flux.fill(0);
    for (Index f = opening.patch.begin; f < opening.patch.end; ++f) q_b[f - mesh.n_internal] = 1;
    projection.project(flux, one.share, grad, q_b, 0);
  }
}

void BulkFriction::begin() {
  for (Changing& one : changing_) one.before = one.opening->pressure;
}

void BulkFriction::add(CellField<Real>& p, const CellField<Real>& q, Real k, Real dt_rho) const {
  if (k == 0) return;
  for (Index c = 0; c < p.size(); ++c) p[c] += k * q[c];
  for (const Changing& one : changing_) {
    const Real rise = k * dt_rho * (one.opening->pressure - one.before);
    if (rise == 0) continue;
    for (Index c = 0; c < p.size(); ++c) p[c] -= rise * one.share[c];
  }
}

Real bulk_friction(const Mesh& mesh, const FaceWeights& weights,
                   const std::vector<Condition>& conditions, Method method) {
  constexpr Real tolerance = 1e-3, room = 0.9;
  FaceMatrix A(mesh);
  const auto add = [&](Index c, Real a) {
    if (c < mesh.n_owned) A.diagonal[c] += a;
  };
  for (Index f = 0; f < mesh.n_internal; ++f) {
    A.off_diagonal[f] = -weights.g[f];
    add(mesh.owner[f], weights.g[f]), add(mesh.neighbour[f], weights.g[f]);
  }
  bool held = false;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (fixes_pressure(conditions[i]) || lets_slip(conditions[i])) continue;
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f)
      add(mesh.owner[f], weights.g[f]), held = true;
  }
  if (all_of_ranks(!held)) return 0;
  LinearSystem system(mesh, "p", method, false, tolerance);
  system.assemble(A);
  CellField<Real> w(mesh);
  std::vector<Real> b(mesh.V.begin(), mesh.V.begin() + mesh.n_owned);
  system.solve(w, b);
  Real most = 0;  // a rank may have no cells
  for (const Real y : w.owned()) most = std::max(most, y);
  return room / global_max(most);
}

}  // namespace fsi::flow
