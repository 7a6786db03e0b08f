#pragma once
// Time series as csv.

#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi::io {

/// A csv file of named columns, written by rank 0, 17 significant digits, flushed row by row.
/// Invariant: the file holds a header and whole rows of finite numbers.
class Table {
 public:
  /// Collective. Creates the file, or with resume_at keeps the whole rows whose first column (the
  /// time) is not beyond it. Errors: Error{io} when it cannot be written; Error{input} when a file
  /// to be resumed has other columns. Error{input}, too, where a name is empty, is there twice, has
  /// a blank at its ends, or a comma, a quote or a line break in it.
  Table(const std::string& file, std::vector<std::string> columns);
  /// The same in a restart at time resume_at.
  Table(const std::string& file, std::vector<std::string> columns, Real resume_at);

  /// Collective; rank 0's values are written. Errors: Error{numerics} naming the column of a value
  /// that is not finite, Error{internal} where there are more or fewer values than columns; nothing
  /// is then written. Error{io}; the rows before it stay whole.
  void row(std::span<const Real> values);

 private:
  void require_columns(std::size_t count) const;
  std::string file_;
  std::vector<std::string> columns_;
  std::ofstream stream_;
  std::uintmax_t whole_ = 0;  // bytes of the header and the whole rows
};

}  // namespace fsi::io
