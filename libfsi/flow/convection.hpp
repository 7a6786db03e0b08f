#pragma once
// The convective term of the momentum equation.

#include <string>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::flow {

/// How the velocity at a face is made of those of its cells.
enum class Convection {
  linear,         ///< linear between the cells, damped at irregular faces
  symmetric,      ///< the mean of both cells: makes no kinetic energy on any mesh
  linear_upwind,  ///< linear from the cell upwind
  limited         ///< linear_upwind without new extremes
};
/// Their names, in that order.
std::vector<std::string> convection_names();
/// The name of a scheme.
std::string name_of(Convection scheme);
/// The scheme of that name. Errors: Error{input}.
Convection convection_of(const std::string& name);

/// conv_c = sum_f phi_f u_f - u_c sum_f phi_f: div(phi u) integrated over owned cells; exact for a
/// uniform u whatever phi is.
///
///   symmetric  u_f = (u_P + u_N) / 2
///   linear     u_f = (u_P + u_N) / 2 + L_f . m - (beta / 2) sign(phi) (u_N - u_P - L_f . d)
///
/// at irregular faces, m from the midpoint to the centroid; symmetric at others. The mean, whatever
/// the distances, is what makes the term skew-symmetric for a flux free of divergence:
/// sum_c u_c . conv_c = 0 but for the boundary [Trias14]. L_f . m makes it linear where the mesh is
/// not even, at the price of some energy; L_f, of the vertices, is blind to what alternates from
/// cell to cell. What is between costs the last part, a difference of third order, with
/// beta = |m| / (4 |d|), at most 1: on tetrahedra of all kinds it leaves no growing mode
/// (doc/verification/tetrahedra.md).
void convection(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                const BoundaryField<Vec3>& u_b, const std::vector<Tensor>& L_f,
                const FaceWeights& weights, const Mesh& mesh, bool symmetric);

/// The same upwind, U and D the cells up- and downwind, L_U the gradient of U (in triangles and
/// tetrahedra L_f), u_lin the linear value without damping, in each component
///
///   linear_upwind  u_f = u_U + L_U . (x_f - x_U)
///   limited        u_f = u_U + psi(r) (u_lin - u_U),  psi = min(1, max(0, 2 r)),
///                  r = 2 (L_U . d) / (u_D - u_U) - 1                                [Sweby84]
///
/// L: of the cells, owned and halo.
void convection_upwind(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                       const BoundaryField<Vec3>& u_b, const CellField<Tensor>& L,
                       const std::vector<Tensor>& L_f, const FaceWeights& weights, const Mesh& mesh,
                       bool limited);

}  // namespace fsi::flow
