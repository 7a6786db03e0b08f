#pragma once
// What a run leaves behind: tables, summary, progress line.

#include <optional>
#include <string>
#include <vector>

#include "libfsi/analysis/motion.hpp"
#include "libfsi/analysis/orientation.hpp"
#include "libfsi/core/clock.hpp"
#include "libfsi/core/run.hpp"
#include "libfsi/io/manifest.hpp"
#include "libfsi/io/table.hpp"
#include "libfsi/solver/case.hpp"

namespace fsi {

/// Watches a Solver and writes the files of a run. Invariant: from construction on, summary.json
/// says how the run stands; it reads "failed" until finish().
class Output {
 public:
  /// Collective. Makes the directory, writes run.yaml and opens the tables. flow_patch: the patch
  /// whose flow rate is reported; "" where there is none. Errors: Error{io}.
  Output(const Case& which, const Options& options, const Solver& solver, const std::string& driver,
         std::string flow_patch = "");
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Whether the run may go on; false once wall time is up or the end was asked for.
  bool go_on();
  /// Time of the next event that a step must hit.
  Real next_event() const;
  /// Collective. After every step of length dt: writes what is due and the progress line.
  void after_step(const Limit& limit, Real dt);
  /// Collective. Last files; returns how the run ended.
  Ending finish();

 private:
  void write_row(const Limit& limit, Real dt);
  void write_solid();
  void write_progress(const Limit& limit, Real dt, Real divergence) const;
  std::string summary(const std::string& status) const;

  const Case& case_;
  const Options& options_;
  const Solver& solver_;
  std::string driver_, flow_patch_;
  Every sample_;
  std::optional<io::Table> flow_;
  std::optional<io::Table> solid_;
  analysis::Tracker tracker_;
  Vec3 axis_;
  Real volume_0_ = 0, drift_ = 0;
  Stopwatch watch_;
  Real progress_at_ = 0, rows_at_ = 0, divergence_ = 0;
  std::int64_t row_step_ = 0;
  bool interrupted_ = false, finished_ = false;
};

}  // namespace fsi
