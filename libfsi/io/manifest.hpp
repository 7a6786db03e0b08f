#pragma once
// The record of a run: run.yaml and summary.json; the progress line.

#include <map>
#include <string>

#include "libfsi/core/types.hpp"
#include "libfsi/core/version.hpp"

namespace fsi::io {

/// The content of summary.json (see the documentation of the output files).
struct Summary {
  /// The driver, how the run ended, and the sentence of an error.
  std::string case_name, status = "failed", message;
  std::string version = fsi::version(), commit = fsi::commit();  ///< of the library
  GlobalIndex cells = 0;                                         ///< of all ranks
  int ranks = 1;                                                 ///< count of MPI ranks
  std::int64_t steps = 0, rejected_steps = 0;                    ///< since t = 0
  std::int64_t first_step = 0;  ///< taken before a restart, outside wall_seconds
  /// At the end, in the units of the case; seconds since the start or restart.
  Real t = 0, wall_seconds = 0, solid_volume_drift = 0, divergence_max = 0;
  std::map<std::string, Real> phases;  ///< seconds
  std::map<std::string, Real> limits;  ///< steps that each limit set, since the start or restart
  std::map<std::string, Real> rejections;  ///< steps taken back, by reason, since then
};

/// Collective. Makes the directory and returns its name. Errors: Error{io}.
const std::string& make_directory(const std::string& directory);
/// Collective. Writes `text` to a file through a temporary one. Errors: Error{io}.
void write_text(const std::string& file, const std::string& text);
/// summary.json as text; a number that is not finite becomes null.
std::string json(const Summary& summary);

}  // namespace fsi::io
