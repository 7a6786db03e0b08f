#pragma once
// Numbers from csv files.

#include <string>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/field/boundary.hpp"

namespace fsi {

/// A column of a table: the names that its header may have; none: any.
using ColumnNames = std::vector<std::string>;

/// Collective. The numbers of a csv file, row by row, one for each of `columns`, with a comma, a
/// semicolon or blanks between them. Empty lines and those that begin with # are left out. One line
/// of names may come before the numbers. Then every column must have one of its own; upper or lower
/// case and text in brackets do not matter. option: that gives the file. Errors: Error{input} that
/// names the file, and the option, line or column.
std::vector<std::vector<Real>> read_rows(const std::string& file,
                                         const std::vector<ColumnNames>& columns,
                                         const std::string& option = "");

/// Collective. The second column over the first, which is `t` or `time`; straight lines between the
/// rows, the first and last value beyond them; period > 0: repeated with it. value: names of the
/// second; option: as above. Errors: Error{input}.
OfTime series(const std::string& file, Real period = 0, const ColumnNames& value = {},
              const std::string& option = "");

/// What looks mistaken in rows of time and value, in a run to `end`; "" where nothing does. period:
/// as above. A run that sees almost nothing of them may have another unit of time, and a last row
/// that should repeat the first may not.
std::string doubt_about(const std::vector<std::vector<Real>>& rows, Real period, Real end);

}  // namespace fsi
