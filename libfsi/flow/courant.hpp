#pragma once
// Courant numbers: the limit of a step, and the convection that is implicit in it.

#include <utility>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/flow/convection.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::flow {

/// Courant numbers of the flow. A mesh of tetrahedra has cells much flatter than those around them.
/// The flattest one would ask for a step of a tenth or less of that of as many hexahedra. A
/// triangle or tetrahedron therefore counts with the rate of its neighbourhood,
///   r_c = sum_{v of c} R_v / sum_{v of c} V_v,   R_v = sum_{c' at v} 1/2 sum_f |phi_f|,
/// V_v the volume of the cells c' at vertex v. For its convection beyond Co_0 the predictor
/// (Momentum) has an implicit term in increments, div(kappa grad(u^(n+1) - u^n)). Co_0 is 0.6, and
/// 0.3 with upwind convection.
///   kappa_f g_f = a_f rho |phi_f| / 2
///   a_f = max(iota_f^2 / (Co_0 (iota_f - o_f)), iota_f beta / 0.2, b_P, b_N)
///   iota_f = max(iota_P, iota_N, min(1, 2 o_f)),   o_f = min(o_P, o_N),   o_c = 1 - Co_0 / Co_c
///   iota_c = R_c o_c, limited to 0 to 1,   b_c = iota_c (R_c - 1) / 0.2
///   R_c = sum_all |phi_f| / sum_inner |phi_f|
/// beta is the upwind share of the scheme. iota_c is 0 in cells that are not triangles or
/// tetrahedra, and a face has the term only if iota_P or iota_N is above 0. With it the convection
/// of a step is stable for all waves and sizes of cells. Taken as the mean of both cells and
/// divided by V + K, K that of kappa, it stays within Co_0. The error is of the size of |d| dt |u|
/// grad grad du/dt. It is 0 in a steady flow, and of second order if mesh and step are refined
/// together.
class Courant {
 public:
  /// Collective. The mesh must outlive it.
  explicit Courant(const Mesh& mesh, Convection scheme = Convection::linear);

  /// Whether some rank has a triangle or tetrahedron.
  bool any_simplex() const { return any_simplex_; }
  /// Co_0.
  Real explicit_part() const { return bound_; }
  /// Collective. The largest r_c [1 / time].
  Real rate(const FaceField<Real>& phi) const;
  /// Collective. How long a step may be for upwind convection that is explicit: the Courant number
  /// 0.25 in every cell, or in all but triangles and tetrahedra where `add_implicit` serves these.
  /// A velocity that alternates from cell to cell is damped by 2 Co in a step, and
  /// Adams-Bashforth of third order is stable with 6/11 at most. The largest number with central
  /// convection.
  Real upwind_dt(const FaceField<Real>& phi, bool implicit_served) const;
  /// Collective. r_c of the owned cells from 1/2 sum_f |phi_f| of theirs.
  std::vector<Real> of_neighbourhood(const std::vector<Real>& swept) const;
  /// Collective. kappa_f += the term above at inner faces. rho: the largest density.
  void add_implicit(FaceField<Real>& kappa, const FaceField<Real>& phi, Real rho, Real dt,
                    const FaceWeights& weights);
  /// Collective, after `add_implicit`. Applies to `change`, which is taken off the velocity after
  /// the momentum equation, the matrix of that equation: (V + K) new = V change. In cells with
  /// iota_c > 0 eight symmetric Gauss-Seidel sweeps solve
  ///   (V_c + sum_f k_f) new_c - sum_f k_f new_N = V_c change_c,   k_f = kappa_f g_f dt / rho.
  /// All other cells keep their change. Without this the pressure gradient would move a flat cell
  /// in full in each step, but the forces that bring it back by V / (V + K) only, and flat cells
  /// would grow. dt_rho: dt / rho.
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
  CellField<Real> over_, implicit_, at_edge_;  // o_c; iota_c; b_c
  std::vector<std::pair<Index, Vec3>> fast_;   // scratch: cells with iota_c > 0, V change
  mutable CellField<Real> swept_;              // scratch: 1/2 sum_f |phi_f|
  mutable std::vector<Real> at_vertex_;        // scratch: R_v
};

}  // namespace fsi::flow
