#pragma once
// The balance of energy of a run: what is stored against what was put in.

#include "libfsi/solver/solver.hpp"

namespace fsi {

/// Collective. sum_c rho u^2 V / 2, rho by the fractions of the cell.
Real kinetic_energy(const Solver& solver);

/// Stored are the kinetic energy and the elastic energy of the solids. What walls, openings,
/// forces, the solids' weight in the fluid and the mean velocity's gradient do on the fluid and
/// solid is the work; viscosity takes some of it away. So stored - work can
/// only fall, and what it rises by the scheme has made, however much was taken before:
///
///   made = max over t > s > t_0 of ((E - W)(t) - (E - W)(s)),  at least 0
///   dW/dt = sum_b {mu g (u_b - u_P) . u_b + alpha_b (tau . S) . u_b - p_b phi - rho |u_b|^2 phi /
///   2}
///           + integral (S + f) . u + sum_i alpha_i {rho_i a_i + (rho_i - rho) g} . u
///
/// over the boundary faces b, S and phi outward, the viscous and elastic part where the velocity is
/// given; by the trapezoidal rule in time. t_0 is the end of the first twenty steps: a flow that
/// starts from an impulse is not judged.
class EnergyBalance {
 public:
  static constexpr int start = 20;  ///< steps that are not judged
  /// Collective. Begins with the solver's state.
  explicit EnergyBalance(const Solver& solver);

  /// Collective. After a step of length dt.
  void add(const Solver& solver, Real dt);

  /// E: kinetic and elastic energy.
  Real stored() const { return stored_; }
  /// dW/dt.
  Real power() const { return power_; }
  /// W: the work done.
  Real work() const { return work_; }
  /// What the scheme has made, as above.
  Real made() const { return made_; }
  /// That in parts of the largest energy that was stored and of the work: what a run may have made
  /// and be right. They count as no less than what rounding may make of the elastic energy, and a
  /// force that the pressure bears of the kinetic energy.
  Real part_made() const;

  /// What a restart goes on from; part of a checkpoint.
  void list(io::Snapshot& snapshot);

 private:
  void set_power_and_stored(const Solver& solver);
  static void add_power(Sum& power, Sum& force, const Solver& solver);
  void add_power_of_boundary(Sum& sum, const Solver& solver);

  BoundaryField<Vec3> u_b_;
  Real least_ = 0, stored_ = 0, largest_ = 0, work_ = 0, done_ = 0, power_ = 0, made_ = 0;
  Real resolved_ = 0;  // below it energies tell nothing
  std::int64_t steps_ = 0;
};

}  // namespace fsi
