#include "libfsi/flow/bulk_friction.hpp"

namespace fsi::flow {

BulkFriction::BulkFriction(const Mesh& mesh, Projection& projection, Openings& openings) {
  constexpr Real round_off = 1e-13;
  FaceField<Real> flux(mesh);
  CellField<Vec3> grad(mesh);
  BoundaryField<Real> q_b(mesh);
  for (const Openings::One& opening : openings.all()) {
    if (opening.given.constant() && !opening.load.any()) continue;
    Changing& one = changing_.emplace_back(&opening, CellField<Real>(mesh));
    if (openings.all().size() == 1) {
      one.share.fill(1);
      continue;
    }
    q_b.fill(0), flux.fill(0);
    for (Index f = opening.patch.begin; f < opening.patch.end; ++f) q_b[f - mesh.n_internal] = 1;
    projection.project(flux, one.share, grad, q_b, round_off * mesh.total_volume);
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
    for (Index c = 0; c < p.size(); ++c) p[c] -= rise * one.share[c];
  }
}

}  // namespace fsi::flow
