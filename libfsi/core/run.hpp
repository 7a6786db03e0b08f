#pragma once
// The rim of every program: set-up and tear-down of MPI and PETSc, and the last catch.

#include <functional>

namespace fsi {

/// How a run ended, when it ended well.
enum class Ending : int { complete = 0, interrupted = 5 };

/// Initialises MPI and PETSc (a first argument ending in .yaml or .yml is the options file), calls
/// body, finalises; with -version prints program, version and commit instead. Returns the exit code
/// of the program: the Ending, or the Kind of the Error thrown, whose sentence it prints once. An
/// exception on one rank ends all ranks: none is left waiting.
int run(int argc, char** argv, const std::function<Ending()>& body);

}  // namespace fsi
