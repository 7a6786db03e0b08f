#include "libfsi/io/manifest.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi::io {
namespace {

std::string number(Real value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + "\"";
}

}  // namespace

void make_directory(const std::string& directory) {
  std::error_code code;
  if (rank() == 0) std::filesystem::create_directories(directory, code);
  if (!all_of_ranks(!code))
    throw Error(Kind::io,
                "directory \"" + directory + "\" cannot be made: " + broadcast(code.message()));
}

void write_text(const std::string& file, const std::string& text) {
  bool good = true;
  if (rank() == 0) {
    const std::string temporary = file + ".tmp";
    std::ofstream stream(temporary, std::ios::trunc);
    stream << text << std::flush;
    good = stream.good();
    stream.close();
    std::error_code code;
    if (good) std::filesystem::rename(temporary, file, code);
    good = good && !code;
  }
  if (!all_of_ranks(good)) throw Error(Kind::io, "file \"" + file + "\" cannot be written");
}

std::string json(const Summary& s) {
  const Real work = static_cast<Real>(s.cells) * static_cast<Real>(s.steps);
  std::string phases;
  for (const auto& [name, seconds] : s.phases)
    phases += (phases.empty() ? "" : ", ") + quoted(name) + ": " + number(seconds);
  return "{\n  \"case\": " + quoted(s.case_name) + ",\n  \"status\": " + quoted(s.status) +
         ",\n  \"message\": " + quoted(s.message) + ",\n  \"cells\": " + std::to_string(s.cells) +
         ",\n  \"ranks\": " + std::to_string(s.ranks) +
         ",\n  \"steps\": " + std::to_string(s.steps) + ",\n  \"t\": " + number(s.t) +
         ",\n  \"rejected_steps\": " + std::to_string(s.rejected_steps) +
         ",\n  \"wall_seconds\": " + number(s.wall_seconds) +
         ",\n  \"us_per_cell_step\": " + number(work > 0 ? 1e6 * s.wall_seconds / work : 0) +
         ",\n  \"phases\": {" + phases +
         "},\n  \"solid_volume_drift\": " + number(s.solid_volume_drift) +
         ",\n  \"divergence_max\": " + number(s.divergence_max) + "\n}\n";
}

}  // namespace fsi::io
