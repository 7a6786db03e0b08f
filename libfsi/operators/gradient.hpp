#pragma once
// The cell gradient: Gauss's theorem with weights corrected to be exact for linear fields.

#include <span>
#include <string>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi {

/// Weights of the quasi-Green gradient [Syrakos23]. With d_cf the vector from cell c to the value
/// beyond face f and the Gauss-linear weights g0_cf = lambda_cf S_cf / V_c, it is
///   grad q_c = sum_f g_cf (q_f - q_c),   g_cf = M_c^-1 g0_cf,   M_c = sum_f g0_cf (x) d_cf.
/// On an orthogonal mesh M = I. That is plain Gauss, the adjoint of the face-averaged divergence.
/// Boundary faces take part where the field has a value there; on the other patches the field is
/// extrapolated linearly from inside.
struct GradientStencil {
  /// has_value[i]: whether the field is given on mesh.patches[i]. mirrors[i] (empty: false):
  /// whether mesh.patches[i] are planes of symmetry. A value there belongs to the foot of the
  /// cell's centre on the face, not to the centre of the face: the velocity of the cell along the
  /// plane is such a value. A pressure without a value has no slope along the normal there.
  GradientStencil(const Mesh& mesh, const FaceWeights& weights, const std::vector<bool>& has_value,
                  const std::vector<bool>& mirrors = {});

  const FaceWeights& weights;   ///< of the faces
  std::vector<Vec3> owner;      ///< [n_faces] g_Pf; zero on patches without a value
  std::vector<Vec3> neighbour;  ///< [n_internal] g_Nf
  std::vector<char> given;      ///< [n_boundary] 1 on patches with a value
  std::vector<char> mirror;     ///< [n_boundary] 1 on planes of symmetry
  std::vector<Vec3> image;   ///< [n_boundary] weight of the rise to the cell's image there, else 0
  std::vector<Index> unfit;  ///< owned cells with too few neighbours for a linear fit
  /// Owned cells that are not triangles or tetrahedra and have faces without a value. For each of
  /// them the inverse of I - (1/V) sum S (x) e over these faces, e from `to_boundary`. Where that
  /// is singular, faces with another one across the cell are left out, and I is taken where that
  /// does not help. The gradient of a pressure needs it.
  std::vector<Index> closed_cells;
  std::vector<Tensor> closed;  ///< as above

  /// The vector from the cell's centre along which a pressure without a value is continued to
  /// boundary face f: d, and on a plane of symmetry its part along the plane.
  Vec3 to_boundary(Index f, const Mesh& mesh) const {
    const Vec3 &d = mesh.d[f], &S = mesh.Sf[f];
    return mirror[f - mesh.n_internal] != 0 ? d - (dot(d, S) / norm2(S)) * S : d;
  }

  /// g_cf of face f for its cell P, or for N.
  const Vec3& weight(Index f, bool of_owner) const { return of_owner ? owner[f] : neighbour[f]; }
};

/// grad q in every owned cell, halo updated. q: owned and halo set; q_b: values on the boundary
/// faces, read only where the stencil has weights.
void gradient(CellField<Vec3>& grad, const CellField<Real>& q, const BoundaryField<Real>& q_b,
              const GradientStencil& stencil, const Mesh& mesh);
/// The gradient of a pressure. Its force must be conservative, a sum of face values:
///   grad q_c = (1/V) sum_f (q_f - q_c) S,
///   q_f = (1 - lambda) q_P + lambda q_N + (grad q)_f . skew,
/// S outward, (grad q)_f that of irregular faces. But for the skewness it is the adjoint of the
/// flux of lambda u_P + (1 - lambda) u_N, so that a pressure works on a velocity through the
/// divergence of that flux alone [Trias14]. It is exact for linear fields. On a boundary face
/// without a value q_f = q_P + grad q_c . e, e from `to_boundary`. In triangles and tetrahedra
/// (grad q)_f takes the place of grad q_c there: with the cell's own gradient q_f would depend on
/// q_P four times as strongly.
/// Owned cells, halo updated. g_f: of q at the irregular faces, by VertexMean; q: owned and halo.
void pressure_gradient(CellField<Vec3>& grad, const std::vector<Vec3>& g_f,
                       const CellField<Real>& q, const BoundaryField<Real>& q_b,
                       const GradientStencil& stencil, const Mesh& mesh);
/// L_ij = d u_i / d x_j (L.xy = du_x/dy).
void gradient(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const GradientStencil& stencil, const Mesh& mesh);
/// The same on listed owned cells only; other cells keep their values, the halo is not touched.
void gradient(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells);

}  // namespace fsi
