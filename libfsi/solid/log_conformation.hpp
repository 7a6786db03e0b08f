#pragma once
// Kinematics of the solid: transport of psi = log B, B the left Cauchy-Green tensor.

#include <span>
#include <vector>

#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/log_tensor.hpp"
#include "libfsi/solid/strain.hpp"

namespace fsi::solid {

/// The strain, carried as psi = log B:
///   d psi/dt + div(u psi) - psi div u = rate of log B             [Fattal04] (19)
/// in the known cells. Face values are limited by Ko (koren.hpp). Heun's method takes psi over dt,
/// or over parts of it (strain.hpp), with phi and L frozen. Then the trace of psi is removed, so
/// that det B = 1, and psi is extrapolated around the solid. B = exp(psi) is positive definite for
/// every psi. The method is of second order in space and time: a step takes psi from t^(n-1/2) to
/// t^(n+1/2).
class LogConformation {
 public:
  /// mesh must outlive it.
  explicit LogConformation(const Mesh& mesh, const SymmetryFaces& symmetry = {});

  /// Below this fraction a cell has no stress: alpha is then rounding of the interface.
  static constexpr Real alpha_min = 1e-9;
  /// The part of the step after which the momentum equation takes the solid.
  static constexpr Real time_offset = 0.5;
  /// The longest step over the time in which the elastic wave passes a cell. Beyond 2, waves along
  /// the surface grow if 300 mu_s = rho c_s h. At 2, the elastic energy of a ring in a pipe is a
  /// fifth above that of short steps.
  static constexpr Real elastic_number = 1.5;
  /// Whether B is set in cells around the solid as well.
  static constexpr bool extended = true;

  /// psi = 0.
  void set_undeformed(const CellField<Real>& alpha);
  /// Collective. Sets anew what follows from psi and alpha, after a change of psi from outside.
  /// grad: scratch.
  void resume(const CellField<Real>& alpha, CellField<SymGradient>& grad);

  /// Collective. Lists the known cells, on which `transport` works. alpha: the fraction that
  /// decides which cells these are.
  void mark(const CellField<Real>& alpha) {
    known_.rebuild(alpha, alpha_known);
    extension_.mark(alpha, known_);
  }
  /// Owned cells on which `transport` reads L.
  std::span<const Index> strain_cells() const { return known_.cells(); }
  /// The band of these.
  const Band& known() const { return known_; }

  /// Collective, after `mark` with the same alpha. On return psi is set on owned cells and halo,
  /// zero far from the solid. grad: scratch. The strain returned is that of the inner cells, so
  /// thin parts of the solid do not limit the step.
  Strain transport(const CellField<Real>& alpha, const FlowSnapshot& snapshot, Real dt,
                   CellField<SymGradient>& grad);

  /// Sets B, positive definite, of a cell; then `resume`.
  void set(Index c, const SymTensor& B, Real /*alpha*/) { psi[c] = log(B); }
  /// Collective. B and lambda, its largest eigenvalue, on the cells of the band of alpha >=
  /// alpha_min. Around the known cells log B is extrapolated as a constant: linearly extrapolated,
  /// the stress at the surface would change by more than the stiffness times the strain of a cell.
  /// B: zero in other cells. Returns the smallest eigenvalue of B among cells with solid, at most
  /// 1.
  Real update_B(CellField<SymTensor>& B, CellField<Real>& lambda, const CellField<Real>& alpha,
                const Band& band);
  /// B of a cell.
  SymTensor B(Index c, Real alpha) const;

  CellField<SymTensor> psi;  ///< log B

 private:
  /// Sets L_. In the simplex zone it is that of InterfaceGradient. In other inner cells it is the
  /// gradient without the divergence of the cell velocities (solenoidal.hpp). Other outermost cells
  /// take the one-sided gradient (one_sided.hpp). In outermost cells, and in all cells of the zone
  /// near walls, L is then bounded by the work of the force over dt (work_bound.hpp).
  void set_L(const CellField<Real>& alpha, const FlowSnapshot& snapshot, Real dt);
  /// Sets rate_ on known_.core(). Returns the largest rate of log B along particles.
  Real rate(const FlowSnapshot& snapshot, CellField<SymGradient>& grad);
  /// Heun's method over dt from rate_ on known_.core(). Returns the rate of its second stage.
  Real advance(const FlowSnapshot& snapshot, Real dt, CellField<SymGradient>& grad);
  /// Relaxes psi towards log B_xi, where B_xi is the B of the memory xi:
  ///   psi <- psi + vartheta (1 - exp(-0.2 Co - 0.05 c_s dt / h)) (log B_xi - psi),
  /// vartheta = `trust`, Co the Courant number of the cell, c_s = `wave_speed`. The transport
  /// smears psi with each cell that the flow crosses, but not the memory. If a stiff body hardly
  /// moves through the mesh, waves along its surface grow, and the term in c_s damps them. In the
  /// simplex zone the exponent is -0.05 Co - 0.02 c_s dt / h in 2-D, and -0.2 Co - 0.1 c_s dt / h
  /// in 3-D. The memory's B is rougher in the zone, and the fourth-difference filter damps the
  /// waves.
  void recall(const FlowSnapshot& snapshot, Real dt);
  /// det B = 1: psi <- psi - (tr psi / 3) I; in plane strain psi_zz = 0 and half of tr psi.
  SymTensor isochoric(SymTensor p) const;

  const Mesh& mesh_;
  Band known_;
  Extension extension_;
  std::vector<SymTensor> old_, rate_;  // in the order of known_.core()
  std::vector<Tensor> L_;              // in the order of known_.core()
};

}  // namespace fsi::solid
