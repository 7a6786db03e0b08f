#pragma once
// Courant numbers: what limits a step, and what of convection is explicit in it.

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
/// V_v the volume of the cells c' at vertex v. What of its own Courant number Co is beyond C
/// is taken by an implicit term in increments (Momentum). C is 0.6 for central and 0.3 for upwind
/// convection.
///   kappa_f g_f = a_f rho |phi_f| / 2,
///   a_f = max(1 / C - 1 / M, (m / C^2 - 1 / m) / 2, 0).
/// M and m are the larger and the smaller Co of the two cells. By the first the diagonal of the
/// momentum matrix grows by Co / C in a cell among larger ones, so that C of it is explicit. The
/// second keeps Co sin(th) / (1 + a Co (1 - cos th)) below C for all waves where all cells are
/// alike. The term is div(kappa grad(u^(n+1) - u^n)). It is an error of the size of |d| dt |u| grad
/// grad du/dt, so of second order where mesh and step are refined together, and 0 in a steady flow.
/// All other cells have their own rate and no such term.
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

 private:
  /// R_v of swept_.
  void sum_at_vertices() const;
  /// r_c of an owned cell.
  Real of_cell(Index c) const;

  const Mesh& mesh_;
  Real bound_;
  bool any_simplex_ = false;
  std::vector<Real> volume_;             // [points] V_v; 0 where there is no simplex at all
  CellField<Real> courant_;              // scratch: Co / C
  mutable CellField<Real> swept_;        // scratch: 1/2 sum_f |phi_f|
  mutable std::vector<Real> at_vertex_;  // scratch: R_v
};

}  // namespace fsi::flow
