#pragma once
// The orthogonal projection, which removes the divergence of the cell velocities.

#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/linear_system.hpp"

namespace fsi::flow {

/// g_f of irregular faces between two cells is linear between the gradients of these.
void face_means(std::vector<Tensor>& g_f, const CellField<Tensor>& L, const FaceWeights& weights,
                const Mesh& mesh);

/// Let Phi(u) = [lambda u_P + (1 - lambda) u_N + L_f . delta_1-lambda] . S be the flux of the cell
/// velocities, with L_f linear between the gradients of both cells. Let div be the outward sum over
/// a cell's faces. calG is the adjoint of the divergence div Phi:
///
///   calG q = -(1/V) (div Phi)^T q,   M q = div Phi(calG q) = div Phi(u*),   u = u* - calG q.
///
/// The part taken from u is orthogonal to the part that stays. So a pressure works on no velocity
/// that is free of divergence, and kinetic energy is kept [Trias14]. calG gives the gradient of a
/// smooth p in the mean over some cells, not in each cell. At a wall q has the value of the cell.
/// Pressures are therefore rougher than with the compact projection.
///
/// M is never assembled. Conjugate gradients solve for q, with the cycle of the compact Laplacian
/// A. The eigenvalues of M / A lie between 0.037 and 2.5 on a mesh of Delaunay tetrahedra, between
/// 0.004 and 15 on slivers. Modes with a small eigenvalue need many iterations, but hardly move the
/// velocity. Each step continues from the last pressure, so that later steps remove what one step
/// leaves.
///
/// The flow may be given on all patches, or slip. A given pressure is not allowed.
class Orthogonal {
 public:
  /// Collective. stencil: of the velocity's gradient; all must outlive it.
  Orthogonal(const Mesh& mesh, const GradientStencil& stencil,
             const std::vector<Condition>& conditions);

  /// calG p, owned and halo; p: owned and halo.
  void set_gradient(CellField<Vec3>& grad, const CellField<Real>& p);
  /// phi = Phi(u) of a velocity that is zero at the boundary or slips there; u: owned and halo.
  void set_flux(FaceField<Real>& phi, const CellField<Vec3>& u);

  /// Takes the flux Phi(calG q) from phi. On return q and grad_q = calG q (owned and halo) leave a
  /// tenth of the divergence or `absolute`, in the norm over the cells. Returns the iterations.
  /// Errors: Error{numerics} if a hundred of them are not enough, or phi is not finite.
  int project(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
              LinearSystem& compact, Real absolute);
  /// The part of the divergence that is left.
  static constexpr Real tolerance = 0.1;

 private:
  void add_skewed(CellField<Vec3>& grad, const CellField<Real>& p);

  const Mesh& mesh_;
  const GradientStencil& stencil_;
  std::vector<char> slips_;  // [n_boundary]
  CellField<Tensor> L_;      // gradient of a velocity, or the adjoint of it applied to a pressure
  std::vector<Tensor> L_f_;
  BoundaryField<Vec3> u_b_;
  CellField<Real> z_, direction_;
  CellField<Vec3> slope_;     // calG of the direction
  FaceField<Real> flux_;      // Phi of that
  std::vector<Real> r_, Md_;  // [n_owned]
};

}  // namespace fsi::flow
