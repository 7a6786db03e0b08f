#pragma once
// The balance of energy of a run: stored energy against work.

#include <optional>

#include "libfsi/solver/solver.hpp"

namespace fsi {

/// B of every cell: the unit tensor outside the solid.
CellField<SymTensor> B_field(const Body& body, const Mesh& mesh);

/// Collective. Elastic energy of a solid's B, with left_cauchy_green of B / (det B)^(1/dim).
Real elastic_energy(const Body& body);
/// The same with the B of `B_field`.
Real elastic_energy(const Body& body, CellField<SymTensor> B);

/// Collective. sum_c rho u^2 V / 2, rho by the fractions of the cell.
Real kinetic_energy(const Solver& solver);

/// Stored are the kinetic energy and the elastic energy of the solids, together E. The work W is
/// that of walls, openings, forces, the solids' weight in the fluid and the mean velocity's
/// gradient. Viscosity only takes energy away, so E - W can only fall. Any rise of it was made by
/// the scheme, however much viscosity took before:
///
///   R = E - W,  made = max over t > s > t_0 of R(t) - R(s),  at least 0
///   dW/dt = sum_b {mu (g (u_b - u_P) + L_b . k + e_b) . u_b + alpha_b (tau . S) . u_b -
///                  (p_b + rho |u_b|^2 / 2) phi}
///           + integral (S + f) . u + sum_i alpha_i {rho_i a_i + (rho_i - rho) g} . u
///
/// b are the boundary faces, S and phi outward, k = S - g d, e_b the excess of a flat wall
/// (WallParabola). L_b . k is there where a velocity or a flow rate is given, the other viscous and
/// the elastic part at walls too. p, p_b, S, tau
/// and alpha of a step are those of its middle: they take the mean of the old and the new u and
/// phi, the other terms the mean of both powers. R is taken at the middle of the step, with the
/// mean of both kinetic energies. t_0 is the end of the first twenty steps, since a flow that
/// starts from an impulse is not judged.
///
/// This is the work against the viscous stress mu grad u of the momentum equation, which takes
/// mu |grad u|^2. The work of the whole stress, and 2 mu D : D, are larger by
///   integral mu div(u . grad u) = sum_b mu (L_P^T . S) . u_b,
/// where a velocity or a flow rate is given; at walls and openings it counts as 0.
class EnergyBalance {
 public:
  static constexpr int start = 20;  ///< steps that are not judged
  /// Collective. Begins with the solver's state.
  explicit EnergyBalance(const Solver& solver);

  /// Collective. After a step of length dt. Errors: Error{numerics} where the body force is not
  /// finite at the end of the step; nothing is added.
  void add(const Solver& solver, Real dt);

  /// Collective. Goes on from the solver's state, once that and the list were read. If other
  /// densities or moduli make it store more or less than at the checkpoint, that counts as work.
  void resume(const Solver& solver);

  /// E: kinetic and elastic energy.
  Real stored() const { return stored_; }
  /// The power of that work: dW/dt in the mean of the last step, and what is added at its end.
  Real power() const { return power_ + power_of_turning_; }
  /// The largest E so far, or what is rounding if that is more.
  Real largest() const { return largest_; }
  /// The work done by the whole stress: W and what is added above.
  Real work() const { return work_ + turning_; }
  /// What the scheme has made, as above.
  Real made() const { return made_; }
  /// `made` in parts of the largest stored energy and of the work, the figure by which a run is
  /// judged. Both count as no less than the rounding of the elastic energy, and than the error of
  /// the kinetic energy of a force that the pressure balances.
  Real part_made() const;
  /// Whether the first steps are over, so that energies tell something.
  bool started() const { return steps_ > start; }

  /// Lists what a restart continues from; part of a checkpoint.
  void list(io::Snapshot& snapshot);

 private:
  void set_velocities(const Solver& solver);
  void keep_velocities(const Solver& solver);
  void set_powers_and_stored(const Solver& solver);
  /// mu (L_P^T . S) . u_b of boundary face f.
  Real power_of_turning(const Solver& solver, Index f) const;
  static void add_power_of_force(Sum& power, Sum& force, const Solver& solver);
  void add_power_of_weight(Sum& power, Sum& force, const Solver& solver) const;
  void add_power_of_boundary(Sum& of_flow, Sum& of_step, Sum& of_turning, const Solver& solver);
  /// What the parabola of the walls adds to mu g (u_b - u_P) . u_b.
  void add_power_of_parabola(Sum& sum, const Solver& solver) const;

  BoundaryField<Vec3> u_b_, u_b_old_;        // now, and after the step before
  BoundaryField<Real> phi_b_old_;            // its flux
  std::optional<CellField<Vec3>> u_old_;     // where a solid has a weight
  Real through_ = 0, through_old_ = 0;       // mean velocity, where it is held
  Real power_of_flow_ = 0;                   // of what belongs to the flow's time
  Real power_of_step_ = 0;                   // of what belongs to the middle of the last step
  Real power_of_turning_ = 0, turning_ = 0;  // of mu (L_P^T . S) . u_b, and its work
  Real kinetic_ = 0, elastic_ = 0;
  Real least_ = 0, stored_ = 0, largest_ = 0, work_ = 0, done_ = 0, power_ = 0, made_ = 0;
  Real resolved_ = 0;  // below it energies are rounding
  std::int64_t steps_ = 0;
};

}  // namespace fsi
