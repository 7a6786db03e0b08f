#pragma once
// What a run goes on from, its own checkpoint or the flow of another run, and with.

#include <cstdint>
#include <deque>
#include <string>

#include "libfsi/io/checkpoint.hpp"
#include "libfsi/run/case.hpp"

namespace fsi {

/// The options of the simulated case, a line "name value" for each: all but those of mesh, time and
/// output.
std::string simulated(const Options& options);

/// A sentence on the differences between this run's `simulated` and that of the run that it
/// continues; "" if there are none. Errors: Error{input} if a difference is in the shape or place
/// of a solid.
std::string differences(const std::string& before, const std::string& now);

/// What must be the same besides the mesh to read a checkpoint: driver, solids with their
/// kinematics, and frame.
std::string identity(const std::string& driver, const Case& setup, const std::deque<Body>& bodies);

/// Collective. The flow begins as in the newest checkpoint in Case::flow_from, and at its time. The
/// solver must have no solid. Errors: Error{input} if there is no checkpoint, if it is of another
/// mesh or driver, of a run with solids, or of a time that is not before the end of this run.
void start_from_other_run(Solver& solver, const Case& setup);

/// Collective. A sentence on the options, but those of solids, that the run of
/// `start_from_other_run` had with other values; now: of this run, as `simulated` has it. "" if
/// there are none.
std::string changes_of_flow(const Solver& solver, const Case& setup, const std::string& now);

/// Prints such a sentence, if it is not empty, as a notice.
void tell_of_changes(const std::string& sentence);

/// Prints from where a run goes on; file: its checkpoint. Errors: Error{input} if the checkpoint is
/// of a time behind the end of the run.
void tell_of_start(const State& state, Real end, const std::string& file);

/// Removes the checkpoints and the tables of solids of an earlier run. Where that run did not come
/// to its end, its newest checkpoint is set aside, and a notice says so.
void begin_anew(const std::string& directory, const io::Checkpoint& checkpoints);

/// Tables, fields and checkpoints are of the `before` solids that were there at the start. Errors:
/// Error{input} if the solver has another number of them.
void require_same_solids(const Solver& solver, std::size_t before);

/// Sets the options for the body that goes on from the checkpoint of this run in the same program.
/// seconds: since this run began, the same on all ranks.
void hand_on(const OutputSetup& output, Real seconds);

/// "700 steps", and if the run began behind some of them, how many it made itself.
std::string text_of_steps(std::int64_t all, std::int64_t first);

}  // namespace fsi
