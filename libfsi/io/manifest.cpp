#include "libfsi/io/manifest.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/file.hpp"

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
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + "\"";
}

std::string object(const std::map<std::string, Real>& items) {
  std::string text;
  for (const auto& [name, value] : items)
    text += (text.empty() ? "" : ", ") + quoted(name) + ": " + number(value);
  return "{" + text + "}";
}

}  // namespace

const std::string& make_directory(const std::string& directory) {
  std::error_code code;
  if (rank() == 0) std::filesystem::create_directories(directory, code);
  if (!all_of_ranks(!code))
    throw Error(ErrorKind::io,
                "directory \"" + directory + "\" cannot be made: " + broadcast(code.message()));
  return directory;
}

void write_text(const std::string& file, const std::string& text) {
  std::string reason;
  if (rank() == 0) reason = replace_file(file, {std::as_bytes(std::span(text))}, Durable::no);
  reason = broadcast(reason);
  if (!reason.empty())
    throw Error(ErrorKind::io, "file \"" + file + "\" could not be written: " + reason);
}

std::string json(const Summary& s) {
  const Real work = static_cast<Real>(s.cells) * static_cast<Real>(s.steps - s.first_step);
  return "{\n  \"case\": " + quoted(s.case_name) + ",\n  \"status\": " + quoted(s.status) +
         ",\n  \"version\": " + quoted(s.version) + ",\n  \"commit\": " + quoted(s.commit) +
         ",\n  \"message\": " + quoted(s.message) + ",\n  \"cells\": " + std::to_string(s.cells) +
         ",\n  \"ranks\": " + std::to_string(s.ranks) +
         ",\n  \"steps\": " + std::to_string(s.steps) + ",\n  \"t\": " + number(s.t) +
         ",\n  \"rejected_steps\": " + std::to_string(s.rejected_steps) +
         ",\n  \"wall_seconds\": " + number(s.wall_seconds) +
         ",\n  \"us_per_cell_step\": " + number(work > 0 ? 1e6 * s.wall_seconds / work : 0) +
         ",\n  \"phases\": " + object(s.phases) + ",\n  \"limits\": " + object(s.limits) +
         ",\n  \"rejections\": " + object(s.rejections) +
         ",\n  \"solid_volume_drift\": " + number(s.solid_volume_drift) +
         ",\n  \"divergence_max\": " + number(s.divergence_max) + "\n}\n";
}

}  // namespace fsi::io
