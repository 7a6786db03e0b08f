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

  const FaceWeights& weights;
  std::vector<Vec3> owner;      ///< [n_faces] g_Pf; zero on patches without a value
  std::vector<Vec3> neighbour;  ///< [n_internal] g_Nf
  std::vector<char> given;      ///< [n_boundary] 1 on patches with a value
};

/// grad q in every owned cell, halo updated. q: owned and halo set; q_b: values on the boundary
/// faces, read only where the stencil has weights.
void gradient(CellField<Vec3>& grad, const CellField<Real>& q, const BoundaryField<Real>& q_b,
              const GradientStencil& stencil, const Mesh& mesh);
/// The gradient of a pressure, whose force must be one of face values: with `first` the gradient
/// above,
///   grad q_c = (1/V) sum_f (q_f - q_c) S,
///   q_f = (1 - lambda) q_P + lambda q_N + (first)_f . skew,
/// S outward, q_P + first . d where the boundary has no value. Exact for linear fields too; without
/// skewness the same. The weights g of a face's two cells differ on irregular cells, and a pressure
/// that alternates from cell to cell, as these make it, has a mean force with them: on a Delaunay
/// mesh 1 to 2 % of the drag on the walls of a channel, whatever its fineness. first: set where the
/// mesh is skewed.
void pressure_gradient(CellField<Vec3>& grad, CellField<Vec3>& first, const CellField<Real>& q,
                       const BoundaryField<Real>& q_b, const GradientStencil& stencil,
                       const Mesh& mesh);
/// sum_c += (1/V) sum_f (first)_f . skew S in the listed owned cells, first . d S on boundary faces
/// without a value: the rest of q_f above. first: owned and halo.
void add_skewness(CellField<Vec3>& sum, const CellField<Vec3>& first,
                  const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells);
/// L_ij = d u_i / d x_j (L.xy = du_x/dy).
void gradient(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const GradientStencil& stencil, const Mesh& mesh);
/// The same on listed owned cells only; other cells keep their values, the halo is not touched.
void gradient(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells);

}  // namespace fsi
