#pragma once
// The convective term of the momentum equation.

#include <string>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/kinks.hpp"

namespace fsi::flow {

/// The scheme for the velocity at a face.
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

/// conv_c = sum_f phi_f u_f - u_c sum_f phi_f, div(phi u) integrated over owned cells. It is exact
/// for a uniform u with any phi.
///
///   symmetric  u_f = (u_P + u_N) / 2
///   linear     u_f = (u_P + u_N) / 2 + L_f . delta - (beta / 2) sign(phi) (u_N - u_P - L_f . d)
///
/// At irregular faces delta = delta_1/2 (`from_midpoint`), and `linear` equals `symmetric` at all
/// other faces. The mean of both cells, whatever their distances, makes the term skew-symmetric for
/// a flux free of divergence: sum_c u_c . conv_c = 0 but for the boundary [Trias14]. The term L_f .
/// delta makes it exact for linear fields on uneven meshes, at the cost of some energy. L_f is a
/// mean over vertices and hardly responds to a u that alternates from cell to cell. The last part,
/// of third order, damps modes in between, with beta = |delta_1/2| / (4 |d|), at most 1. On
/// tetrahedra of all kinds no mode grows with it (doc/verification/tetrahedra.md).
void convection(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                const BoundaryField<Vec3>& u_b, const std::vector<Tensor>& L_f,
                const FaceWeights& weights, const Mesh& mesh, bool symmetric);

/// conv += the part of `linear` at faces between whose cells u has a kink,
///   u_f = (u_P + u_N) / 2 + excess_f.
/// Without it a kink that passes the mesh leaves an error of first order in its velocity.
void add_kinks(CellField<Vec3>& conv, const FaceField<Real>& phi, const Kinks& kinks,
               const Mesh& mesh);

/// The upwind schemes. U and D are the cells up- and downwind, L_U is the gradient of U (in
/// triangles and tetrahedra L_f), and u_lin the linear value without damping. In each component
///
///   linear_upwind  u_f = u_U + L_U . (x_f - x_U)
///   limited        u_f = u_U + Sw(r) (u_lin - u_U),  Sw = min(1, max(0, 2 r)),
///                  r = 2 (L_U . d) / (u_D - u_U) - 1                                [Sweby84]
///
/// L: of the cells, owned and halo.
void convection_upwind(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                       const BoundaryField<Vec3>& u_b, const CellField<Tensor>& L,
                       const std::vector<Tensor>& L_f, const FaceWeights& weights, const Mesh& mesh,
                       bool limited);

}  // namespace fsi::flow
