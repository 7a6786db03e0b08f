#pragma once
// Wall time by phase of the step: for the summary of a run and for PETSc's -log_view.

#include <map>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi {

/// Named phases and the seconds spent in each.
class Profile {
 public:
  /// Adds a phase, with a PETSc log event "fsi NAME" that all Profiles share; returns its number.
  int add(const std::string& name);
  std::map<std::string, Real> seconds() const;
  /// PETSc's number of a phase's log event.
  int event(int number) const { return items_[static_cast<std::size_t>(number)].event; }

  /// Time between construction and destruction counts for the phase.
  class Phase {
   public:
    Phase(Profile& profile, int number);
    ~Phase();
    Phase(const Phase&) = delete;
    Phase& operator=(const Phase&) = delete;

   private:
    Profile& profile_;
    int number_;
    Real start_;
  };

 private:
  struct Item {
    std::string name;
    int event;
    Real seconds;
  };
  std::vector<Item> items_;
};

}  // namespace fsi
