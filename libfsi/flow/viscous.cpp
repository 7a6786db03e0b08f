#include "libfsi/flow/viscous.hpp"

namespace fsi::flow {

void mixture_viscosity(FaceField<Real>& mu, const CellField<Real>& alpha, Real mu_f, Real mu_s,
                       const FaceWeights& weights, const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Real a_P = alpha[mesh.owner[f]], a_N = alpha[mesh.neighbour[f]];
    mu[f] = mu_f + (mu_s - mu_f) * (a_P + weights.lambda[f] * (a_N - a_P));
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
    mu[f] = mu_f + (mu_s - mu_f) * alpha[mesh.owner[f]];
}

void viscous_compact(CellField<Vec3>& visc, const FaceField<Real>& mu, const CellField<Vec3>& u,
                     const BoundaryField<Vec3>& u_b, const ViscousBoundary& boundary,
                     const FaceWeights& weights, const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    const Vec3 flux = mu[f] * weights.g[f] * (u[N] - u[P]);
    visc[P] += flux;
    visc[N] -= flux;
  }
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f], b = f - mesh.n_internal;
    if (boundary.open[b] == 0) visc[P] += mu[f] * weights.g[f] * (u_b[b] - u[P]);
  }
}

void viscous_past(CellField<Vec3>& visc, const FaceField<Real>& mu, const FaceField<Real>& theta,
                  Real ratio, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                  const CellField<Vec3>& u_past, const BoundaryField<Vec3>& u_b_past,
                  const ViscousBoundary& boundary, const FaceWeights& weights, const Mesh& mesh) {
  const auto change = [&](Index c) { return u[c] - u_past[c]; };
  for (Index f = 0; f < mesh.n_faces; ++f) {
    if (theta[f] == 0.5) continue;
    const Real a = -(theta[f] - 0.5) * ratio * mu[f] * weights.g[f];
    const Index P = mesh.owner[f];
    if (f < mesh.n_internal) {
      const Index N = mesh.neighbour[f];
      const Vec3 flux = a * (change(N) - change(P));
      visc[P] += flux;
      visc[N] -= flux;
    } else if (const Index b = f - mesh.n_internal; boundary.open[b] == 0) {
      visc[P] += a * (u_b[b] - u_b_past[b] - change(P));
    }
  }
}

void viscous_oblique(CellField<Vec3>& rest, const FaceField<Real>& mu,
                     const std::vector<Tensor>& L_f, const ViscousBoundary& boundary,
                     const FaceWeights& weights, const Mesh& mesh) {
  for (std::size_t i = 0; i < weights.irregular.size(); ++i) {
    const Index f = weights.irregular[i];
    if (f >= mesh.n_internal && boundary.varied[f - mesh.n_internal] == 0) continue;
    const Vec3 flux = mu[f] * dot(L_f[i], weights.k[f]);
    rest[mesh.owner[f]] += flux;
    if (f < mesh.n_internal) rest[mesh.neighbour[f]] -= flux;
  }
}

void viscous_transposed(CellField<Vec3>& rest, const FaceField<Real>& mu, Real mu_0,
                        const CellField<Tensor>& L, const ViscousBoundary& boundary,
                        const Mesh& mesh) {
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const Real excess = mu[f] - mu_0;
    if (excess == 0) continue;
    const Index P = mesh.owner[f];
    if (f >= mesh.n_internal && boundary.open[f - mesh.n_internal] != 0) continue;
    rest[P] += excess * dot(transpose(L[P]), mesh.Sf[f]);
    if (f >= mesh.n_internal) continue;
    const Index N = mesh.neighbour[f];
    rest[N] -= excess * dot(transpose(L[N]), mesh.Sf[f]);
  }
}

}  // namespace fsi::flow
