#pragma once
// Kinematics of the solid: transport of psi = log B, B the left Cauchy-Green tensor.

#include <span>
#include <vector>

#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/log_tensor.hpp"
#include "libfsi/solid/strain.hpp"

namespace fsi::solid {

/// The strain by its logarithm,
///   d psi/dt + div(u psi) - psi div u = rate of log B             [Fattal04] (19)
/// on the cells that the solid fills by half or more, in the middle of the step, as the solver has
/// it. What it does to a speck the extension undoes. Face values are by Koren's limiter. Heun's
/// method goes over dt, or parts of it (strain.hpp), with phi and L frozen. Then come det B = 1 and
/// the extension into the cells around. B = exp(psi) is positive definite whatever happens. Second
/// order in space, and in time: a step takes it from half a step behind the flow to half one ahead.
class LogConformation {
 public:
  /// mesh must outlive it.
  explicit LogConformation(const Mesh& mesh, const SymmetryFaces& symmetry = {});

  /// Below this fraction a cell carries no stress: round-off of the interface.
  static constexpr Real alpha_min = 1e-9;
  /// Where in a step the solid stands when the momentum equation is solved.
  static constexpr Real time_offset = 0.5;
  /// The longest step in units of the time in which the elastic wave passes a cell. Waves along the
  /// surface grow beyond 2 where 300 mu_s = rho c h, and at 2 the elastic energy of a ring in a
  /// pipe is a fifth above that of short steps.
  static constexpr Real elastic_number = 1.5;
  /// Whether B is known around the solid as well.
  static constexpr bool extended = true;

  /// psi = 0.
  void set_undeformed(const CellField<Real>& alpha);
  /// Renews what follows from psi and alpha: after psi was changed from outside. Collective. grad:
  /// scratch.
  void resume(const CellField<Real>& alpha, CellField<SymGradient>& grad);

  /// Collective. Lists the cells that `transport` works on. alpha: what tells which cells
  /// know their strain.
  void mark(const CellField<Real>& alpha) {
    known_.rebuild(alpha, alpha_known);
    extension_.mark(alpha, known_);
  }
  /// Owned cells on which `transport` reads L.
  std::span<const Index> strain_cells() const { return known_.cells(); }
  /// The band of these.
  const Band& known() const { return known_; }

  /// Collective, after `mark` with the same alpha. On return psi is set on owned cells and halo,
  /// zero far from the solid. grad: scratch. The strain returned is that of the inner cells: what
  /// is thinner than the mesh sets no step.
  Strain transport(const CellField<Real>& alpha, const FlowSnapshot& snapshot, Real dt,
                   CellField<SymGradient>& grad);

  /// Sets B, positive definite, of a cell; then `resume`.
  void set(Index c, const SymTensor& B, Real /*alpha*/) { psi[c] = log(B); }
  /// Collective. B and lambda, its largest eigenvalue, on the cells of the band of alpha >=
  /// alpha_min. Around the known cells log B goes on as a constant: continued linearly, the stress
  /// of the surface would answer to a strain of a cell by more than its stiffness tells. B: zero in
  /// other cells. Returns the smallest eigenvalue of B among cells with solid, at most 1.
  Real update_B(CellField<SymTensor>& B, CellField<Real>& lambda, const CellField<Real>& alpha,
                const Band& band);
  /// B of a cell.
  SymTensor B(Index c, Real alpha) const;

  CellField<SymTensor> psi;  ///< log B

 private:
  /// Sets L_: by the fit of one side in its zone, else the velocity gradient without the divergence
  /// of the cell velocities (solenoidal.hpp). In the solid's outermost cells it is that of its own
  /// side (one_sided.hpp). By it they take up no more energy over dt than the force takes from the
  /// flow (work_bound.hpp), but where a traction adds to the force. So do all cells of the zone
  /// near walls.
  void set_L(const CellField<Real>& alpha, const FlowSnapshot& snapshot, Real dt);
  /// Sets rate_ on known_.core(); returns the largest of log B following the solid.
  Real rate(const FlowSnapshot& snapshot, CellField<SymGradient>& grad);
  /// Heun's method over dt from rate_ on known_.core(); returns the rate of its second stage.
  Real advance(const FlowSnapshot& snapshot, Real dt, CellField<SymGradient>& grad);
  /// psi <- psi + (1 - exp(-0.2 Co - 0.05 c dt / h)) trust (log B_memory - psi),
  /// Co the cell's Courant number, c the speed of the elastic wave. psi wears down with the way
  /// through the mesh, which does not touch the map. Where a stiff body hardly moves through the
  /// mesh, waves along its surface grow: what the wave passes draws them back. In the zone it is
  /// 1 - exp(-0.05 Co): the map's B is rougher there, and a filter damps the waves.
  void recall(const FlowSnapshot& snapshot, Real dt);
  /// det B = 1: psi <- psi - (tr psi / 3) I, in plane strain with psi_zz = 0 kept.
  SymTensor isochoric(SymTensor p) const;

  const Mesh& mesh_;
  Band known_;
  Extension extension_;
  std::vector<SymTensor> old_, rate_;  // beside known_.core()
  std::vector<Tensor> L_;              // beside known_.core()
};

}  // namespace fsi::solid
