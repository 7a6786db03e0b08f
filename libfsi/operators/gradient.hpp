#pragma once
// The cell gradient: Gauss's theorem with weights corrected to be exact for linear fields.

#include <span>
#include <string>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi {

/// Weights of the quasi-Green gradient [Syrakos23]: with d_cf the vector from cell c to the value
/// beyond face f and the Gauss-linear weights g0_cf = lambda_cf S_cf / V_c,
///   grad q_c = sum_f g_cf (q_f - q_c),   g_cf = M_c^-1 g0_cf,   M_c = sum_f g0_cf (x) d_cf.
/// On an orthogonal mesh M = I: plain Gauss, the adjoint of the face-averaged divergence.
/// Boundary faces take part where the field has a value there; on the other patches the field is
/// extrapolated linearly from inside.
struct GradientStencil {
  /// has_value[i]: whether the field is given on mesh.patches[i].
  GradientStencil(const Mesh& mesh, const FaceWeights& weights, const std::vector<bool>& has_value);

  std::vector<Vec3> owner;      ///< [n_faces] g_Pf; zero on patches without a value
  std::vector<Vec3> neighbour;  ///< [n_internal] g_Nf
};

/// grad q in every owned cell, halo updated. q: owned and halo set; q_b: values on the boundary
/// faces, read only where the stencil has weights.
void gradient(CellField<Vec3>& grad, const CellField<Real>& q, const BoundaryField<Real>& q_b,
              const GradientStencil& stencil, const Mesh& mesh);
/// L_ij = d u_i / d x_j (L.xy = du_x/dy).
void gradient(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const GradientStencil& stencil, const Mesh& mesh);
/// The same on listed owned cells only; other cells keep their values, the halo is not touched.
void gradient(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells);

}  // namespace fsi
