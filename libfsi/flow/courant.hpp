#pragma once
// Courant numbers: what limits a step, and what of convection is explicit in it.

#include <utility>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/flow/convection.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::flow {

/// Courant numbers of the flow. A tetrahedral mesh has cells much flatter than those around them. A
/// step as short as the flattest asks for is a tenth or less of what hexahedra of the same count
/// take. So a triangle or tetrahedron has the rate of its neighbourhood,
///   r_c = sum_{v of c} R_v / sum_{v of c} V_v,   R_v = sum_{c' at v} 1/2 sum_f |phi_f|,
/// V_v the volume of the cells c' at vertex v. What of its own Courant number Co is beyond C is
/// taken by an implicit term in increments (Momentum), div(kappa grad(u^(n+1) - u^n)). C is 0.6 for
/// central and 0.3 for upwind convection.
///   kappa_f g_f = a_f rho |phi_f| / 2
///   a_f = max(s^2 / (C (s - q)), s beta / 0.2, b_P, b_N)
///   s = max(s_P, s_N, min(1, 2 q))
///   q = min(1 - C / Co_P, 1 - C / Co_N)
/// where s_P or s_N is above 0: s_c = (1 - C / Co_c) sum_f |phi_f| / sum_inner |phi_f|, from 0 to
/// 1, in triangles and tetrahedra. beta is the upwind share of the scheme, and
/// b_c = s_c / 0.2 sum_b |phi_b| / sum_inner |phi_f| that of the boundary faces b. So the
/// convection of a step, as the mean of both cells and without the gradient, divided by V + K with
/// K of kappa, stays within C for all waves, whatever the cells' sizes. The term is an error of the
/// size of |d| dt |u| grad grad du/dt, so of second order where mesh and step are refined together,
/// and 0 in a steady flow. All other cells have their own rate, and a term only beside such a cell.
class Courant {
 public:
  /// Collective. The mesh must outlive it.
  explicit Courant(const Mesh& mesh, Convection scheme = Convection::linear);

  /// Whether some rank has a triangle or tetrahedron.
  bool any_simplex() const { return any_simplex_; }
  /// C.
  Real explicit_part() const { return bound_; }
  /// Collective. The largest r_c [1 / time].
  Real rate(const FaceField<Real>& phi) const;
  /// Collective. r_c of the owned cells from 1/2 sum_f |phi_f| of theirs.
  std::vector<Real> of_neighbourhood(const std::vector<Real>& swept) const;
  /// Collective. kappa_f += the term above at inner faces. rho: the largest density.
  void add_implicit(FaceField<Real>& kappa, const FaceField<Real>& phi, Real rho, Real dt,
                    const FaceWeights& weights);
  /// Collective, after `add_implicit`. Shares what is taken off the velocity after the momentum
  /// equation as the matrix of that equation would do it, (V + K) new = V change. In the cells with
  /// s_c > 0 four symmetric sweeps of Gauss and Seidel solve
  ///   (V_c + sum_f k_f) new_c - sum_f k_f new_N = V_c change_c,   k_f = kappa_f g_f dt / rho.
  /// Others keep their change. Without it a gradient of the pressure moves a flat cell by the whole
  /// of it in each step. What drives the cell back moves it by V / (V + K) alone, and flat cells
  /// grow. dt_rho: dt / rho.
  void share(CellField<Vec3>& change, const FaceField<Real>& kappa, Real dt_rho,
             const FaceWeights& weights);

 private:
  /// R_v of swept_.
  void sum_at_vertices() const;
  /// r_c of an owned cell.
  Real of_cell(Index c) const;

  const Mesh& mesh_;
  Convection scheme_;
  Real bound_;
  bool any_simplex_ = false;
  std::vector<Real> volume_;                   // [points] V_v; 0 where there is no simplex at all
  CellField<Real> over_, implicit_, at_edge_;  // 1 - C / Co; s_c; b_c
  std::vector<std::pair<Index, Vec3>> fast_;   // scratch: cells with s_c > 0, V change
  mutable CellField<Real> swept_;              // scratch: 1/2 sum_f |phi_f|
  mutable std::vector<Real> at_vertex_;        // scratch: R_v
};

}  // namespace fsi::flow
