// A program that ends in every way a run can: rim -mode MODE. What is seen from outside is checked
// by rim.py.

#include <petscksp.h>

#include <csignal>
#include <stdexcept>

#include "libfsi/core/error.hpp"
#include "libfsi/core/options.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/core/run.hpp"
#include "libfsi/core/signals.hpp"

namespace fsi {
namespace {

/// The last rank throws while the others wait for it.
void fail_alone(ErrorKind kind) {
  if (rank() == ranks() - 1) throw Error(kind, "one rank alone");
  all_of_ranks(true);
}

void fail_in_petsc(const char* type) {
  KSP solver = nullptr;
  FSI_PETSC(KSPCreate(comm(), &solver));
  FSI_PETSC(PetscOptionsSetValue(nullptr, "-ksp_type", type));
  FSI_PETSC(KSPSetFromOptions(solver));
}

RunStatus body() {
  Options options("rim", "ends in every way");
  const std::string mode = options.text("mode", "complete", "how to end");
  const Real value = options.real("value", 1, {.help = "a number", .positive = true});
  if (options.help()) return RunStatus::complete;
  options.check_unknown();
  if (mode == "input") throw Error(ErrorKind::input, "all ranks alike");
  if (mode == "numerics") throw Error(ErrorKind::numerics, "all ranks alike");
  if (mode == "io") throw Error(ErrorKind::io, "all ranks alike");
  if (mode == "internal") throw std::runtime_error("all ranks alike");
  if (mode == "memory") throw std::bad_alloc();
  if (mode == "alone-input") fail_alone(ErrorKind::input);
  if (mode == "alone-numerics") fail_alone(ErrorKind::numerics);
  if (mode == "alone-io") fail_alone(ErrorKind::io);
  if (mode == "petsc") fail_in_petsc("nonsense");
  if (mode == "petsc-call") FSI_PETSC(PetscOptionsSetValue(nullptr, "no dash", ""));
  if (mode == "again") {
    set_option("mode", "complete"), set_option("value", "9");
    return RunStatus::again;
  }
  if (mode == "interrupted") return RunStatus::interrupted;
  if (mode == "signal") {
    if (rank() == ranks() - 1) std::raise(SIGTERM);
    return pending_signal() == Signal::end ? RunStatus::interrupted : RunStatus::complete;
  }
  if (rank() == 0) std::printf("value %g\n", value);
  return RunStatus::complete;
}

}  // namespace
}  // namespace fsi

int main(int argc, char** argv) { return fsi::run(argc, argv, fsi::body); }
