#pragma once
// Warnings on standard error if a result is doubtful, and notices when a solid leaves the mesh.

#include <string>
#include <vector>

#include "libfsi/run/records.hpp"
#include "libfsi/solver/energy.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {

/// Collective. How evenly the ranks share the solids, and a notice of each solid that is cut by
/// planes of symmetry whose images do not make it whole.
void tell_of_solids(const Solver& solver);

/// A notice if the case has solids and the solver none.
void tell_of_missing_solids(const Solver& solver, std::size_t in_case);

/// A warning if the Output was called for fewer steps than were made.
void tell_of_steps(std::int64_t made, std::int64_t told);

/// A warning that no finish() ended the run; returns its text.
std::string tell_of_no_finish();

/// Prints each of these once in a run, on rank 0.
class Watch {
 public:
  /// bodies: count of solids.
  explicit Watch(std::size_t bodies) : said_(bodies) {}

  /// Collective. A warning if `made`, the part of the energy that the scheme made, is suspicious.
  /// If it is most of the energy, the result is the reason why the run must end, since it is wrong.
  /// Both name the place of the largest strain. Else "".
  std::string energy(Real made, const Solver& solver);
  /// A warning where a step begins at or past the end of the run.
  void end(Real begin, Real end);
  /// The next three, by the columns `reynolds` and `dissipation` of a row of flow.csv; dt: the last
  /// step, 0 as long as the run is not judged.
  void flow(const std::vector<Entry>& row, const EnergyBalance& energy, Real dt, Real t);
  /// A warning if viscosity takes more energy in a step of length dt than all that is stored, and
  /// ten times the work. Then the velocity alternates from cell to cell. taken: by viscosity per
  /// time.
  void dissipation(Real taken, const EnergyBalance& energy, Real dt, Real t);
  /// A warning if half of what viscosity takes comes from nothing:
  ///   made = integral of the dissipation + rise of the stored energy - work.
  /// It is judged each time when viscosity has taken twice the largest energy stored meanwhile and
  /// a tenth of the largest of the run, by twenty values of `taken` or more.
  void source(Real taken, const EnergyBalance& energy, Real dt, Real t);
  /// Collective. After every step; dt as for `flow`. `source`, if its last value is five steps old.
  void between_rows(Solver& solver, const EnergyBalance& energy, Real dt);
  /// A warning if the flow through the openings is beyond a laminar one in a vessel.
  void reynolds(Real number);
  /// A notice when many attempts at the `steps` of this run failed, with the reason of most of them
  /// and, where a step was given, the advice to give a shorter one.
  void taken_back(const StepReport& report, std::int64_t steps, const Limit& asked);
  /// Collective. Notices when a solid begins to leave the mesh, and when it has. A warning when the
  /// flow takes what is left of it back into the mesh.
  void leaving(const Solver& solver);
  /// Collective. A run goes on from a checkpoint: what was told of solids that leave, and of films,
  /// is not told again.
  void resume(const Solver& solver);
  /// Collective. A notice when the ranks no longer share the cells of the solids evenly; whether
  /// a new division is worth it. In a run that goes on, just divided, the busiest rank's share must
  /// have grown since the first call: to 1.5 times, or half the way to all cells on one rank.
  /// divides: the run will divide the mesh anew.
  bool balance(const Solver& solver, bool divides, bool goes_on);
  /// A warning if a solid is strained more than the mesh resolves, and one if the energy of its
  /// stress is not that of its shape. Then they differ by more than half of the larger one, which
  /// is not small beside what the solid or the flow has. Others if it has more pieces than at the
  /// first call, if it comes off the walls that it was bonded to, and if its map has lost half of
  /// its volume somewhere. A notice if a film between it and a wall, or two of the solids, is
  /// thinner than the mesh resolves.
  void strain(std::size_t body, const Solver& solver, const Soundness& sound,
              const EnergyBalance& energy);

 private:
  struct Said {
    bool leaving = false, left = false, strained = false, torn = false, forgetful = false,
         off = false, unmapped = false, sliding = false, back = false, crumbled = false;
    int pieces = -1;  // at first
    int agreed = 0;   // values in a row in which strain and shape belong to each other
  };
  void bond(std::size_t body, const Solver& solver, const Soundness& sound);
  void crumbs(std::size_t body, const Solver& solver);
  void map(std::size_t body, const Solver& solver, const Soundness& sound);
  /// Collective.
  void films(std::size_t body, const Solver& solver);
  /// The time over which viscosity, work and stored energy are compared.
  struct Span {
    Real begin = 0, work = 0, stored = 0;          // at its begin
    Real t = 0, rate = 0, taken = 0, largest = 0;  // at the last value; of stored
    int values = -1;                               // after the first; -1: there is none yet
  };
  std::vector<Said> said_;  // of the bodies
  Span span_;
  int steps_since_ = 0;  // the last value of `source`
  bool told_of_source_ = false, told_of_energy_ = false, told_of_turbulence_ = false,
       told_of_steps_ = false, told_of_end_ = false, told_of_dissipation_ = false,
       told_of_balance_ = false, told_of_touch_ = false;
  Real share_at_start_ = -1;  // the busiest rank's in the solid's cells, over the mean
};

}  // namespace fsi
