#include "libfsi/solid/elastic_force.hpp"

#include <cmath>

#include "libfsi/operators/stencil.hpp"

namespace fsi::solid {
namespace {

/// Whether a list has boundary face f.
bool has(const std::vector<char>* list, const Mesh& mesh, Index f) {
  return list != nullptr && (*list)[f - mesh.n_internal] != 0;
}

/// tau . S on boundary face f; on a plane of symmetry and at a film only its normal part.
Vec3 traction(const SymTensor& tau, const ElasticState& solid, const Mesh& mesh, Index f) {
  const Vec3 S = mesh.Sf[f], t = dot(tau, S);
  const bool mirror = solid.mirror != nullptr && solid.mirror->has(f, mesh);
  return mirror || has(solid.film, mesh, f) ? (dot(t, S) / norm2(S)) * S : t;
}

/// The vector from the centre of P along which T is continued to boundary face f. It leads to the
/// centre of the face. At a plane of symmetry only its part along the plane counts, since n . T . n
/// has no slope across the plane.
Vec3 to_face(const ElasticState& solid, const Mesh& mesh, Index f) {
  const Vec3 d = mesh.d[f];
  if (solid.mirror == nullptr || !solid.mirror->has(f, mesh)) return d;
  const Vec3& S = mesh.Sf[f];
  return d - (dot(d, S) / norm2(S)) * S;
}

/// (grad)_f . r, the mean of the two cells of internal face f.
SymTensor mean_along(const CellField<SymGradient>& grad, const Vec3& r, Index f,
                     const FaceWeights& weights, const Mesh& mesh) {
  const Real lambda = weights.lambda[f];
  return (1 - lambda) * along(grad[mesh.owner[f]], r) + lambda * along(grad[mesh.neighbour[f]], r);
}

}  // namespace

ElasticForce::ElasticForce(const Mesh& mesh, const FaceWeights& weights, Real G)
    : mesh_(mesh), G_(G), jump_force_(mesh, weights) {}

void ElasticForce::add_cell_averaged(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                                     const ElasticState& solid, const FaceWeights& weights,
                                     const Band& band, const CellField<SymGradient>& grad) const {
  const CellField<SymTensor>& T = solid.T;
  const CellField<Real>& alpha = solid.alpha;
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    const Vec3 d = mesh_.d[f], n = d / norm(d);
    if (f >= mesh_.n_internal) {
      if (has(solid.open, mesh_, f)) continue;
      // tau_b = tau_P + grad tau . d
      const SymTensor aT_b = alpha[P] * T[P] + along(grad[P], to_face(solid, mesh_, f));
      force[P] += (1 / mesh_.V[P]) * traction(G_ * dev(aT_b), solid, mesh_, f);
      continue;
    }
    const Index N = mesh_.neighbour[f];
    const Real lambda = weights.lambda[f];
    const SymTensor rise = alpha[N] * T[N] - alpha[P] * T[P];
    rhie_chow_source[f] += dot(n, dot(G_ * dev(rise - mean_along(grad, d, f, weights, mesh_)), n));
    // (aT)_f = (1 - lambda) aT_P + lambda aT_N + (grad aT)_f . skew, aT = alpha T
    SymTensor T_f = (1 - lambda) * alpha[P] * T[P] + lambda * alpha[N] * T[N];
    if (weights.place[f] >= 0) T_f += mean_along(grad, weights.skew[f], f, weights, mesh_);
    const Vec3 t = dot(G_ * dev(T_f), mesh_.Sf[f]);
    force[P] += (1 / mesh_.V[P]) * t;
    force[N] -= (1 / mesh_.V[N]) * t;
  }
}

void ElasticForce::add_cut_face(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                                const ElasticState& solid, const FaceWeights& weights,
                                PressureStencil& pressure, const Band& band,
                                const CellField<SymGradient>& grad) {
  const CellField<SymTensor>& T = solid.T;
  const CellField<Real>& alpha = solid.alpha;
  jump_force_.clear();
  for (const Index f : band.faces()) {
    const Index P = mesh_.owner[f];
    const Real a_f = (*solid.alpha_f)[f];
    const Vec3 S = mesh_.Sf[f], d = mesh_.d[f], n = d / norm(d);
    if (f >= mesh_.n_internal) {
      if (has(solid.open, mesh_, f)) continue;
      // alpha_b (tau_b - s I) + alpha_P s I,  tau_b = tau_P + grad tau . d
      const SymTensor tau = G_ * dev(T[P] + along(grad[P], to_face(solid, mesh_, f)));
      const Vec3& m = (*solid.normal)[f];
      const Real s = dot(m, dot(tau, m));
      force[P] +=
          (1 / mesh_.V[P]) * (a_f * traction(tau, solid, mesh_, f) + ((alpha[P] - a_f) * s) * S);
      continue;
    }
    const Index N = mesh_.neighbour[f];
    const Real lambda = weights.lambda[f];
    SymTensor T_f = face_mean(T, f, weights, mesh_);
    if (weights.place[f] >= 0) T_f += mean_along(grad, weights.skew[f], f, weights, mesh_);
    const SymTensor tau = G_ * dev(T_f);
    const Vec3 m = (*solid.normal)[f], t = dot(tau, S);
    const Real s = dot(m, dot(tau, m)), jump = s * (alpha[N] - alpha[P]);
    // alpha_f (tau - s I) + alpha_c s I, and the rise [p]_f that the pressure balances
    force[P] += (1 / mesh_.V[P]) * (a_f * t + ((alpha[P] - a_f) * s) * S);
    force[N] -= (1 / mesh_.V[N]) * (a_f * t + ((alpha[N] - a_f) * s) * S);
    jump_force_.add(f, jump, pressure.cells);
    // the rise of alpha T between the cells without the jump, less the mean of alpha grad T
    const SymTensor smooth = (lambda * alpha[P] + (1 - lambda) * alpha[N]) * (T[N] - T[P]) -
                             (1 - lambda) * alpha[P] * along(grad[P], d) -
                             lambda * alpha[N] * along(grad[N], d);
    rhie_chow_source[f] += jump + dot(n, dot(G_ * dev(smooth), n));
  }
  jump_force_.apply(force, rhie_chow_source, pressure, band);
}

void ElasticForce::apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                         const ElasticState& solid, const FaceWeights& weights,
                         PressureStencil& pressure, const Band& band,
                         CellField<SymGradient>& grad) {
  for (const Index c : last_cells_) grad[c] = {};
  last_cells_ = band.cells();
  const bool sharp = solid.alpha_f != nullptr;
  const SymmetryFaces none, &symmetry = solid.mirror != nullptr ? *solid.mirror : none;
  if (sharp)
    gradient(grad, solid.T, pressure.cells, symmetry, mesh_, band.core());
  else
    gradient(grad, solid.alpha, solid.T, pressure.cells, symmetry, mesh_, band.cells());
  mesh_.halo.update(grad, band.listed());
  if (sharp)
    add_cut_face(force, rhie_chow_source, solid, weights, pressure, band, grad);
  else
    add_cell_averaged(force, rhie_chow_source, solid, weights, band, grad);
  mesh_.halo.update(force);
}

}  // namespace fsi::solid
