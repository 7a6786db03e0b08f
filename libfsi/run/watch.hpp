#pragma once
// Words on standard error where a run is to be doubted, and where a solid leaves it.

#include <string>
#include <vector>

#include "libfsi/run/records.hpp"
#include "libfsi/solver/energy.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {

/// A notice of each solid that is cut by planes of symmetry whose images do not make it whole.
void tell_of_images(const Solver& solver);

/// A notice where the case has solids and the solver none.
void tell_of_missing_solids(const Solver& solver, std::size_t in_case);

/// A warning where fewer steps were told to the Output than were made.
void tell_of_steps(std::int64_t made, std::int64_t told);

/// A warning that no finish() ended the run; returns its text.
std::string tell_of_no_finish();

/// Tells each of these once a run, on rank 0.
class Watch {
 public:
  /// bodies: count of solids.
  explicit Watch(std::size_t bodies) : said_(bodies) {}

  /// Collective. A warning when `made`, the part of the energy that comes from nothing, is odd;
  /// where it is most of it, why the run must end: such a run is wrong, whatever else it tells.
  /// Both name the place where the solid is strained most. Else "".
  std::string energy(Real made, const Solver& solver);
  /// A warning where a step begins at or past the end of the run.
  void end(Real begin, Real end);
  /// The next two, by the columns `reynolds` and `dissipation` of a row of flow.csv.
  void flow(const std::vector<Entry>& row, const EnergyBalance& energy, Real dt, Real t);
  /// A warning where viscosity takes more in a step of length dt than all that is stored, and ten
  /// times what is put in: then the velocity alternates from cell to cell. taken: by viscosity per
  /// time.
  void dissipation(Real taken, const EnergyBalance& energy, Real dt, Real t);
  /// A warning where the flow through the openings is past what stays laminar in a vessel.
  void reynolds(Real number);
  /// A notice when many attempts at the `steps` of this run failed, with the reason of most of them
  /// and, where a step was given, the advice to give a shorter one.
  void taken_back(const StepReport& report, std::int64_t steps, const Limit& asked);
  /// Notices when a solid begins to leave the mesh, and when it has.
  void leaving(const Solver& solver);
  /// A warning when a solid is strained past what the mesh resolves, and when the energy of its
  /// stress is not that of its shape. Another when it falls into more pieces than it had when this
  /// was first asked.
  void strain(std::size_t body, const Solver& solver, const Soundness& sound);

 private:
  struct Said {
    bool leaving = false, left = false, strained = false, torn = false, forgetful = false;
    int pieces = -1;  // at first
  };
  std::vector<Said> said_;  // of the bodies
  bool told_of_energy_ = false, told_of_turbulence_ = false, told_of_steps_ = false,
       told_of_end_ = false, told_of_dissipation_ = false;
};

}  // namespace fsi
