#pragma once
// The viscous term of the momentum equation, div(mu (grad u + grad u^T)), in two parts.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::flow {

/// Face viscosity mu = alpha mu_s + (1 - alpha) mu_f [Matsumiya25] (3), alpha averaged linearly.
void mixture_viscosity(FaceField<Real>& mu, const CellField<Real>& alpha, Real mu_f, Real mu_s,
                       const FaceWeights& weights, const Mesh& mesh);

/// The viscous flux of boundary faces. Openings have none. Where the velocity is given and may vary
/// along the boundary, the explicit part counts. At a wall with one velocity, and on a slip plane,
/// the difference along d is the whole normal derivative.
struct ViscousBoundary {
  std::vector<char> open;    ///< [n_boundary]
  std::vector<char> varied;  ///< [n_boundary]
};

/// visc_c += sum_f mu_f g_f (u_N - u_P): the compact part over owned cells.
void viscous_compact(CellField<Vec3>& visc, const FaceField<Real>& mu, const CellField<Vec3>& u,
                     const BoundaryField<Vec3>& u_b, const ViscousBoundary& boundary,
                     const FaceWeights& weights, const Mesh& mesh);

/// The same of u - u_past, times -(theta_f - 1/2) ratio: the correction for theta, see Momentum.
void viscous_past(CellField<Vec3>& visc, const FaceField<Real>& mu, const FaceField<Real>& theta,
                  Real ratio, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                  const CellField<Vec3>& u_past, const BoundaryField<Vec3>& u_b_past,
                  const ViscousBoundary& boundary, const FaceWeights& weights, const Mesh& mesh);

/// rest_c += sum_f mu_f L_f . k_f, L_f the gradient at irregular faces: the explicit rest of the
/// normal derivative.
void viscous_oblique(CellField<Vec3>& rest, const FaceField<Real>& mu,
                     const std::vector<Tensor>& L_f, const ViscousBoundary& boundary,
                     const FaceWeights& weights, const Mesh& mesh);

/// rest_c += (grad u)_c^T . sum_f (mu_f - mu_0) S_f. By div u = 0 the transposed part is (grad
/// u)^T . grad mu, which acts only where mu changes. The sum of fluxes mu (grad u)_f^T . S_f, also
/// explicit, would respond to the small divergence of the cell velocities everywhere in the more
/// viscous phase.
void viscous_transposed(CellField<Vec3>& rest, const FaceField<Real>& mu, Real mu_0,
                        const CellField<Tensor>& L, const ViscousBoundary& boundary,
                        const Mesh& mesh);

}  // namespace fsi::flow
