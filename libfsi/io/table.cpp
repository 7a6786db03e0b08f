#include "libfsi/io/table.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi::io {

Table::Table(const std::string& file, std::vector<std::string> columns)
    : file_(file), columns_(std::move(columns)) {
  open(std::ios::trunc);
  for (std::size_t i = 0; i < columns_.size(); ++i) stream_ << (i > 0 ? "," : "") << columns_[i];
  stream_ << std::endl;
}

Table::Table(const std::string& file, std::vector<std::string> columns, Real resume_at)
    : file_(file), columns_(std::move(columns)) {
  std::string kept;
  if (rank() == 0) {
    std::ifstream old(file);
    std::string line;
    if (std::getline(old, line)) kept = line + "\n";
    while (std::getline(old, line))
      if (!old.eof() && std::strtod(line.c_str(), nullptr) <= resume_at * (1 + 1e-12))
        kept += line + "\n";
  }
  open(std::ios::trunc);
  if (kept.empty()) {
    for (const std::string& column : columns_) kept += column + ',';
    kept.back() = '\n';
  }
  stream_ << kept << std::flush;
}

void Table::open(std::ios::openmode mode) {
  if (rank() == 0) stream_.open(file_, mode);
  if (!all_of_ranks(rank() != 0 || stream_.good()))
    throw Error(Kind::io, "file \"" + file_ + "\" cannot be written");
}

void Table::row(std::span<const Real> values) {
  FSI_ASSERT(values.size() == columns_.size());
  std::string line, culprit;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) culprit = columns_[i];
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", values[i]);
    if (i > 0) line += ',';
    line += text;
  }
  culprit = broadcast(culprit);
  if (!culprit.empty())
    throw Error(Kind::numerics, "column \"" + culprit + "\" of \"" + file_ + "\" is not finite");
  if (rank() == 0) stream_ << line << std::endl;
  if (!all_of_ranks(rank() != 0 || stream_.good()))
    throw Error(Kind::io, "file \"" + file_ + "\" cannot be written (disk full?)");
}

}  // namespace fsi::io
