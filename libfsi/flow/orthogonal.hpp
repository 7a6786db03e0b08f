#pragma once
// The projection that takes the divergence out of the cells' own velocities.

#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/linear_system.hpp"

namespace fsi::flow {

/// g_f of irregular faces between two cells is linear between the gradients of these.
void face_means(std::vector<Tensor>& g_f, const CellField<Tensor>& L, const FaceWeights& weights,
                const Mesh& mesh);

/// With U(u) = [lambda u_P + (1 - lambda) u_N + L_f . s'] . S the flux that cell velocities make,
/// L_f linear between the gradients of both cells, and D the sum over a cell's faces,
///
///   M q = D U(u),   M = D U G,   G q = -(1/V) (D U)^T q,   u <- u - G q.
///
/// What is taken away is orthogonal to what stays, as G is the adjoint of the divergence: a
/// pressure works on no velocity that is free of divergence, and kinetic energy is kept
/// [Trias14]. G is the gradient of smooth fields in the mean over some cells, not in each. At a
/// wall q has no value but that of the cell. So pressures are rougher than those of the compact
/// projection.
///
/// M is never assembled. Conjugate gradients solve with the cycle of the compact Laplacian A. The
/// eigenvalues of M / A lie between 0.037 and 2.5 on a mesh of Delaunay tetrahedra, between 0.004
/// and 15 on slivers. Modes of small ones need many iterations, but hardly move the velocity, and
/// as q is the increment of a pressure that goes on, what a step leaves the next ones take.
///
/// The flow may be given on all patches, or slip; no pressure is.
class Orthogonal {
 public:
  /// Collective. stencil: of the velocity's gradient; all must outlive it.
  Orthogonal(const Mesh& mesh, const GradientStencil& stencil,
             const std::vector<Condition>& conditions);

  /// G p, owned and halo; p: owned and halo.
  void set_gradient(CellField<Vec3>& grad, const CellField<Real>& p);
  /// phi = U(u) of a velocity that is zero at the boundary or slips there; u: owned and halo.
  void set_flux(FaceField<Real>& phi, const CellField<Vec3>& u);

  /// Takes the flux U(G q) from phi. On return q and grad_q = G q (owned and halo) leave a
  /// tenth of its divergence or `absolute`, in the norm over the cells. Returns the iterations.
  /// Errors: Error{numerics} where a hundred of them are not enough, or phi is not finite.
  int project(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
              LinearSystem& compact, Real absolute);
  /// What is left of the divergence, as a part.
  static constexpr Real tolerance = 0.1;

 private:
  void add_skewed(CellField<Vec3>& grad, const CellField<Real>& p);

  const Mesh& mesh_;
  const GradientStencil& stencil_;
  std::vector<char> slips_;  // [n_boundary]
  CellField<Tensor> L_;      // of a velocity, or what its adjoint makes of a pressure
  std::vector<Tensor> L_f_;
  BoundaryField<Vec3> u_b_;
  CellField<Real> z_, direction_;
  CellField<Vec3> slope_;     // G of the direction
  FaceField<Real> flux_;      // U of that
  std::vector<Real> r_, Md_;  // [n_owned]
};

}  // namespace fsi::flow
