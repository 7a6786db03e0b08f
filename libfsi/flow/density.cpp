#include "libfsi/flow/density.hpp"

#include <algorithm>

namespace fsi::flow {

Density::Density(const Mesh& mesh, const FaceWeights& weights, Real rho_0)
    : mesh_(mesh),
      weights_(weights),
      rho_0_(rho_0),
      least_(rho_0),
      most_(rho_0),
      of_face_(mesh, rho_0),
      of_cell_(mesh, rho_0),
      inertia_(mesh, {rho_0, rho_0, rho_0}) {}

void Density::clear() {
  of_face_.fill(rho_0_);
  of_cell_.fill(rho_0_);
}

void Density::add(Real rho, const CellField<Real>& alpha, const FaceField<Real>& alpha_f,
                  std::span<const Index> faces) {
  const Real excess = rho - rho_0_;
  least_ = std::min(least_, rho), most_ = std::max(most_, rho);
  for (Index c = 0; c < mesh_.n_cells; ++c) of_cell_[c] += excess * alpha[c];
  for (const Index f : faces) of_face_[f] += excess * alpha_f[f];
}

// rhohat_c,k = rho_c + (1/V) sum_f lambda_cf (rho_f - rho_c) d_k S_k
void Density::finish() {
  for (Index f = 0; f < mesh_.n_faces; ++f) of_face_[f] = std::clamp(of_face_[f], least_, most_);
  for (Index c = 0; c < mesh_.n_cells; ++c) {
    const Real rho = of_cell_[c] = std::clamp(of_cell_[c], least_, most_);
    inertia_[c] = {rho, rho, rho};
  }
  const auto add = [&](Index c, Index f, Real share) {
    const Real part = share * (of_face_[f] - of_cell_[c]) / mesh_.V[c];
    if (part == 0) return;
    const Vec3 &d = mesh_.d[f], &S = mesh_.Sf[f];
    inertia_[c] += part * Vec3{d.x * S.x, d.y * S.y, d.z * S.z};
  };
  for (Index f = 0; f < mesh_.n_faces; ++f) {
    const Real lambda = f < mesh_.n_internal ? weights_.lambda[f] : 1;
    add(mesh_.owner[f], f, lambda);
    if (f < mesh_.n_internal) add(mesh_.neighbour[f], f, 1 - lambda);
  }
  for (Index c = 0; c < mesh_.n_owned; ++c)
    for (Real* D : {&inertia_[c].x, &inertia_[c].y, &inertia_[c].z})
      *D = std::clamp(*D, least_, most_);
  mesh_.halo.update(inertia_);
}

Real flux_of_force(const Density& density, const CellField<Vec3>& a, const FaceWeights& weights,
                   const Mesh& mesh, Index f) {
  const Index P = mesh.owner[f];
  const Real rho = density.of_face()[f];
  const auto difference = [&](Index c) -> Vec3 {
    const Vec3& D = density.inertia()[c];
    return {(D.x - rho) * a[c].x, (D.y - rho) * a[c].y, (D.z - rho) * a[c].z};
  };
  if (f >= mesh.n_internal) return dot(difference(P), mesh.Sf[f]);
  const Real lambda = weights.lambda[f];
  return dot(lambda * difference(P) + (1 - lambda) * difference(mesh.neighbour[f]), mesh.Sf[f]);
}

}  // namespace fsi::flow
