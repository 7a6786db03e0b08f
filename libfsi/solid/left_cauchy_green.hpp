#pragma once
// Kinematics of the solid: transport of Bt = alpha^(1/2) B, B the left Cauchy-Green tensor.

#include <cmath>
#include <span>

#include "libfsi/field/band.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/strain.hpp"

namespace fsi::solid {

/// d Bt/dt + div(u Bt) = L . Bt + Bt . L^T            [Matsumiya25] (10)
/// Linear-upwind face values, and Heun's method over dt with phi and L frozen. It is explicit and
/// of second order in space. Works on the cells with alpha >= alpha_min.
class LeftCauchyGreen {
 public:
  /// mesh must outlive it. symmetry: planes beyond which the images of cells count as neighbours.
  explicit LeftCauchyGreen(const Mesh& mesh, SymmetryFaces symmetry = {});

  /// Below this fraction of solid Bt is zero, and so is the stress [Matsumiya25] 2.3.
  static constexpr Real alpha_min = 0.1;
  /// The part of the step after which the momentum equation takes the solid: its end.
  static constexpr Real time_offset = 1;
  /// The longest step over the time in which the elastic wave passes a cell.
  static constexpr Real elastic_number = 0.8;
  /// Whether B is set in cells around the solid as well.
  static constexpr bool extended = false;

  /// Bt with B = I where alpha >= alpha_min. Halo set.
  void set_undeformed(const CellField<Real>& alpha);
  /// Sets anew what follows from Bt and alpha, after a change from outside.
  void resume(const CellField<Real>& alpha, CellField<SymGradient>& /*grad*/) { mark(alpha); }

  /// Collective. Lists the cells that `transport` works on. alpha: of the end of the step.
  void mark(const CellField<Real>& alpha) { band_.rebuild(alpha, alpha_min); }
  /// Owned cells on which `transport` reads L.
  std::span<const Index> strain_cells() const { return band_.core(); }

  /// Collective, after `mark` with the same alpha. On return Bt is set on owned cells and halo,
  /// zero where alpha < alpha_min. grad: scratch. The strain has no limit here: none is returned.
  Strain transport(const CellField<Real>& alpha, const FlowSnapshot& snapshot, Real dt,
                   CellField<SymGradient>& grad);

  /// Sets B of a cell; then `resume`, halo included.
  void set(Index c, const SymTensor& B, Real alpha) {
    Bt[c] = alpha >= alpha_min ? std::sqrt(alpha) * B : SymTensor{};
  }
  /// B (zero where alpha < alpha_min) and lambda, its largest eigenvalue, on the core of the band.
  /// Returns 1, since the smallest eigenvalue of B has no limit here.
  Real update_B(CellField<SymTensor>& B, CellField<Real>& lambda, const CellField<Real>& alpha,
                const Band& band) const;
  /// B of a cell: Bt / alpha^(1/2), the unit tensor where alpha < alpha_min.
  SymTensor B(Index c, Real alpha) const;

  CellField<SymTensor> Bt;  ///< alpha^(1/2) B, what is transported

 private:
  void rate(const FlowSnapshot& snapshot, CellField<SymGradient>& grad);

  const Mesh& mesh_;
  Band band_;
  SymmetryFaces symmetry_;
  std::vector<SymTensor> old_, rate_;  // in the order of the core of the band
};

}  // namespace fsi::solid
