#pragma once
// Wall time of a step's calls: by phase for the summary of a run, by call for PETSc's -log_view.

#include <map>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi {

/// Named calls, the phase that each belongs to, and the seconds spent in each phase.
class Profile {
 public:
  /// Adds a call, with a PETSc log event "fsi NAME" that all Profiles share; returns its number.
  int add(const std::string& name, const std::string& phase);
  /// By phase.
  std::map<std::string, Real> seconds() const;
  /// PETSc's number of a call's log event.
  int event(int number) const { return items_[static_cast<std::size_t>(number)].event; }

  /// Time between construction and destruction counts for the call and its phase.
  class Call {
   public:
    /// number: of the call, from add().
    Call(Profile& profile, int number);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    Profile& profile_;
    int number_;
    Real start_;
  };

 private:
  struct Item {
    std::string phase;
    int event;
    Real seconds;
  };
  std::vector<Item> items_;
};

}  // namespace fsi
