#pragma once
// The frame of every program: set-up and tear-down of MPI and PETSc, and the last catch.

#include <functional>
#include <string>
#include <vector>

namespace fsi {

/// How a run ended, when it ended well; again: it is not at its end, and its body is to be called
/// once more.
enum class RunStatus : int { complete = 0, interrupted = 5, again = -1 };

/// Initialises MPI and PETSc (a first argument ending in .yaml or .yml is the options file), calls
/// body, as long as that returns `again`, finalises; with -version prints program, version and
/// commit instead. Returns the exit code of the program: the RunStatus, or the Kind of the Error
/// thrown, whose sentence it prints once. An exception on one rank ends all ranks: none is left
/// waiting.
int run(int argc, char** argv, const std::function<RunStatus()>& body);

/// One of the things a program of several commands does: PROGRAM NAME OPERANDS... [options].
struct Command {
  std::string name;      ///< the word that chooses it
  std::string operands;  ///< what they are, a word each: "in.msh out.h5"
  std::string purpose;   ///< what it does, for -help
  std::function<RunStatus(const std::vector<std::string>&)> body;  ///< takes the operands
};

/// run() of the command that the first word names. Another or none, or another number of operands:
/// Error{input} that lists the commands; with -help alone they are printed, and a command with
/// -help gets its `operands` as they stand.
int run(int argc, char** argv, const std::vector<Command>& commands);

}  // namespace fsi
