#pragma once
// The output of a run: tables, fields, checkpoints, summary, progress line.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libfsi/core/clock.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/run.hpp"
#include "libfsi/io/checkpoint.hpp"
#include "libfsi/io/fields.hpp"
#include "libfsi/io/file.hpp"
#include "libfsi/io/table.hpp"
#include "libfsi/run/case.hpp"
#include "libfsi/run/records.hpp"
#include "libfsi/run/samples.hpp"
#include "libfsi/run/watch.hpp"
#include "libfsi/solver/energy.hpp"

namespace fsi {

/// A column of flow.csv that a driver adds.
struct Column {
  std::string name;                    ///< not one of flow.csv itself
  std::function<Real(Solver&)> value;  ///< at the state's time; collective, the same on all ranks
  Course course = Course::smooth;      ///< how to interpolate it between two steps
};

/// Watches a Solver and writes the files of a run. Invariant: from construction on, summary.json
/// holds the status of the run; it is "failed" until finish().
///
/// Its files hold the solids that the solver had when it was made. If a solid is put in later, the
/// next call is refused. So a run to which solids are added has one Output, with a folder of its
/// own, for each stretch of time between: finish(), `Solver::put_solid`, the next Output. Each
/// begins at the time of the state, with columns like `turned` and `work` from 0.
class Output {
 public:
  /// Collective. Takes the directory for this run and writes run.yaml. A new run removes the files
  /// that an earlier one left under the same names. With -restart the solver's state, the tables
  /// and the series of fields continue from the newest sound checkpoint, with a notice of changed
  /// options of flow and solid. Errors: Error{io}; Error{input} if another run holds the directory,
  /// there is nothing to continue, or the checkpoint has another driver or kinematics. columns:
  /// appended to those of flow.csv, evaluated at the start and after steps close to a row.
  /// Error{input} if the name of one is not allowed in a table (io::Table).
  Output(const Case& setup, const Options& options, Solver& solver, const std::string& driver,
         std::vector<Column> columns = {});
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Collective. Whether the run may continue; false if a step failed for good, wall time is up,
  /// the end was asked for, or the mesh is to be divided anew. Errors: Error{input} if a solid was
  /// put in since.
  bool go_on();
  /// The times that the next step must hit, a file's, and must not pass, a row's.
  Events next_event() const;
  /// Collective. Call after every step of length dt, 0 if it failed: writes what is due. Errors:
  /// those of the files, after a checkpoint and summary.json are written, as far as possible;
  /// Error{input} if a solid was put in since.
  void after_step(const Limit& limit, Real dt);
  /// Collective. Writes the last files and returns how the run ended. `again`, with -restart_divide
  /// alone: the options now have -restart, and the body, with this Output alone, must return it in
  /// its turn. Errors:
  /// Error{numerics} with the reason if the last step failed; there is a checkpoint of the state
  /// before it. Error{io} if a file, or the checkpoint of an interrupted run, could not be written;
  /// Error{input} if a solid was put in since.
  RunStatus finish();

 private:
  io::Snapshot snapshot();
  void go_on_from_checkpoint();
  void saving(const std::function<void()>& write);
  std::string rescue(ErrorKind kind);
  bool saved() const;
  bool divides_anew();
  std::string where() const;
  void open();
  void open_tables();
  void write_due(const Limit& asked, Real dt);
  void write_rows(const Limit& limit, Real dt);
  std::vector<Row> rows(const Limit& limit, Real dt, Real wall_per_step);
  Limit count(const Limit& limit, Real dt);
  void write_fields();
  void write_last_fields();
  void write_checkpoint();
  void write_progress(const Limit& limit, Real dt);
  std::string summary(const std::string& status) const;

  const Case& case_;
  const Options& options_;
  Solver& solver_;
  std::string driver_, simulated_;
  std::vector<Column> columns_;  // of the driver
  io::Lock lock_;
  io::Checkpoint checkpoints_;
  EnergyBalance energy_;
  Watch watch_;
  std::vector<Real> diameters_;       // of the patches
  std::vector<SolidRecord> records_;  // of the bodies
  Samples samples_;
  std::string samples_text_;  // the content of samples_ for a checkpoint
  Schedule field_, checkpoint_;
  std::optional<io::Table> flow_;
  std::vector<std::optional<io::Table>> solids_;  // of the bodies; none if it had left
  std::optional<io::FieldWriter> fields_;
  Stopwatch stopwatch_;
  Forecast forecast_;
  Real progress_at_ = 0, rows_at_ = 0, divergence_ = 0, fields_at_ = -1;
  std::int64_t row_step_ = 0, first_step_ = 0, saved_step_ = -1, steps_told_ = 0;
  std::map<std::string, Real> limits_;  // number of steps by the limit that set their length
  std::string message_;                 // why the run ended, if no step failed
  bool interrupted_ = false, again_ = false, uneven_ = false, finished_ = false;
};

}  // namespace fsi
