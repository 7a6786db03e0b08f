#include "libfsi/io/table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/file.hpp"

namespace fsi::io {
namespace {

/// Errors: Error{input} where nobody could find the columns by their names.
void require_names(const std::string& file, const std::vector<std::string>& columns) {
  const auto blank = [](unsigned char c) { return std::isspace(c) != 0; };
  const auto breaks = [](unsigned char c) { return c == ',' || c == '"' || std::iscntrl(c) != 0; };
  for (const std::string& name : columns) {
    std::string shown = name;
    std::ranges::replace_if(
        shown, [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
    require(!name.empty() && !blank(name.front()) && !blank(name.back()) &&
                std::ranges::none_of(name, breaks),
            "\"" + shown + "\" cannot be the name of a column of \"" + file +
                "\": a name is not empty and has no blank at its ends, and no comma, quote or " +
                "line break");
    require(std::ranges::count(columns, name) == 1, "\"" + file + "\" would have two columns \"" +
                                                        name +
                                                        "\": rename the one that the driver adds");
  }
}

}  // namespace

Table::Table(const std::string& file, std::vector<std::string> columns)
    : Table(file, std::move(columns), -std::numeric_limits<Real>::infinity()) {}

Table::Table(const std::string& file, std::vector<std::string> columns, Real resume_at)
    : file_(file), columns_(std::move(columns)) {
  require_names(file_, columns_);
  std::string head, reason;
  for (const std::string& column : columns_) head += (head.empty() ? "" : ",") + column;
  std::string kept = head + "\n", found = head;
  if (rank() == 0) {
    // A line without an end was cut off: getline reaches the end of the file in it.
    std::ifstream old(file);
    if (std::isfinite(resume_at) && std::getline(old, found)) {
      for (std::string line; std::getline(old, line);)
        if (!old.eof() && std::strtod(line.c_str(), nullptr) <= resume_at * (1 + 1e-12))
          kept += line + "\n";
    }
    if (found == head) {
      reason = replace_file(file, {std::as_bytes(std::span(kept))}, Durable::no);
      stream_.open(file, std::ios::app);
      whole_ = kept.size();
      if (reason.empty() && !stream_) reason = "it cannot be opened";
    }
  }
  require(all_of_ranks(found == head),
          "file \"" + file + "\" has other columns than this run writes; move it away");
  reason = broadcast(reason);
  if (!reason.empty())
    throw Error(ErrorKind::io, "file \"" + file + "\" could not be written: " + reason);
}

/// As rank 0 has it: its values are written.
void Table::require_columns(std::size_t count) const {
  std::string wrong;
  if (count != columns_.size()) {
    wrong = "a row of \"" + file_ + "\" has " + std::to_string(count) + " values for the " +
            std::to_string(columns_.size()) + " columns ";
    for (const std::string& column : columns_)
      wrong += (&column == &columns_.front() ? "" : ", ") + column;
  }
  wrong = broadcast(wrong);
  if (!wrong.empty()) throw Error(ErrorKind::internal, wrong);
}

void Table::row(std::span<const Real> values) {
  require_columns(values.size());
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
    throw Error(ErrorKind::numerics,
                "column \"" + culprit + "\" of \"" + file_ + "\" is not finite");
  if (rank() == 0) stream_ << line << std::endl;
  const bool good = rank() != 0 || stream_.good();
  if (good) whole_ += line.size() + 1;
  if (!good) {
    std::error_code code;
    stream_.close();  // it tries once more what it could not write
    std::filesystem::resize_file(file_, whole_, code);
  }
  if (!all_of_ranks(good))
    throw Error(ErrorKind::io, "file \"" + file_ + "\" could not be written: is the disk full?");
}

}  // namespace fsi::io
