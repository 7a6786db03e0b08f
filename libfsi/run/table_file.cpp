#include "libfsi/run/table_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <system_error>

#include "libfsi/core/error.hpp"
#include "libfsi/core/option_names.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"

namespace fsi {
namespace {

constexpr std::string_view blanks = " \t\r";

bool one_of(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }

/// Collective. The text of a file as rank 0 reads it, without the mark that some editors put first.
std::string text_of(const std::string& file, const std::string& option) {
  std::string text = "?";
  std::error_code code;
  if (rank() == 0 && !std::filesystem::is_directory(file, code))
    if (std::ifstream stream(file); stream)
      text = std::string(std::istreambuf_iterator<char>(stream), {});
  text = broadcast(text);
  require(text != "?", (option.empty() ? "" : "option -" + option + ": ") +
                           "cannot read the file \"" + file + "\"");
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

/// A name without quotes, blanks around it and capitals; blanks in it become underscores.
std::string plain(std::string name) {
  std::erase_if(name, [](char c) { return one_of(c, "\"'"); });
  const std::size_t first = name.find_first_not_of(blanks), last = name.find_last_not_of(blanks);
  if (first == std::string::npos) return "";
  name = name.substr(first, last - first + 1);
  for (char& c : name)
    c = one_of(c, blanks) ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

/// The names in a header, without what stands in brackets.
std::vector<std::string> names_of(const std::string& header) {
  std::string text;
  int depth = 0;
  for (const char c : header) {
    if (one_of(c, "([")) ++depth;
    if (depth == 0) text += c == ';' ? ',' : c;
    if (one_of(c, ")]")) --depth;
  }
  std::istringstream stream(text);
  std::vector<std::string> names;
  if (text.find(',') == std::string::npos)
    for (std::string name; stream >> name;) names.push_back(plain(name));
  else
    for (std::string name; std::getline(stream, name, ',');) names.push_back(plain(name));
  return names;
}

/// Errors: Error{input} where the header's names are not those of the columns.
void check_header(const std::string& file, const std::string& header,
                  const std::vector<ColumnNames>& columns) {
  std::vector<std::string> expected;
  for (const ColumnNames& names : columns)
    expected.push_back(names.empty() ? "a value" : joined(names, " or "));
  const std::string wanted = "; expected: " + joined(expected) +
                             " (a unit in brackets behind a name, capitals and blanks are allowed)";
  const std::vector<std::string> found = names_of(header);
  const std::string begin = "file \"" + file + "\": ";
  require(found.size() == columns.size(), begin + "its first line \"" + header + "\" names " +
                                              std::to_string(found.size()) + " columns" + wanted);
  for (std::size_t i = 0; i < found.size(); ++i)
    require(columns[i].empty() || std::ranges::count(columns[i], found[i]) > 0,
            begin + "column " + std::to_string(i + 1) + " is called \"" + found[i] + "\"" + wanted);
}

}  // namespace

std::vector<std::vector<Real>> read_rows(const std::string& file,
                                         const std::vector<ColumnNames>& columns,
                                         const std::string& option) {
  std::istringstream stream(text_of(file, option));
  std::vector<std::vector<Real>> rows;
  bool headed = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.ends_with('\r')) line.pop_back();
    const std::size_t first = line.find_first_not_of(blanks);
    if (first == std::string::npos || line[first] == '#') continue;
    const bool number = one_of(line[first], "0123456789+-.");
    if (!number && !headed && rows.empty()) {
      check_header(file, line, columns);
      headed = true;
      continue;
    }
    std::string words = line;
    for (char& c : words) c = one_of(c, ",;") ? ' ' : c;
    std::istringstream items(words);
    std::vector<Real>& row = rows.emplace_back();
    for (Real value; items >> value;) row.push_back(value);
    require(row.size() == columns.size() && items.eof(),
            "file \"" + file + "\": the line \"" + line + "\" is not " +
                std::to_string(columns.size()) + " numbers");
  }
  require(!rows.empty(), "file \"" + file + "\" holds no numbers");
  return rows;
}

OfTime series(const std::string& file, Real period, const ColumnNames& value,
              const std::string& option) {
  const std::vector<std::vector<Real>> rows = read_rows(file, {{"t", "time"}, value}, option);
  for (std::size_t i = 1; i < rows.size(); ++i)
    require(rows[i][0] > rows[i - 1][0], "file \"" + file +
                                             "\": its times must grow from row to row, but " +
                                             print("%g follows %g", rows[i][0], rows[i - 1][0]));
  require(period == 0 || period >= rows.back()[0] - rows.front()[0],
          "file \"" + file +
              print("\" is longer than its period: its times go from %g to %g, the period is %g",
                    rows.front()[0], rows.back()[0], period));
  const auto at = [rows, period](Real t) {
    const Real start = rows.front()[0];
    if (period > 0) t = start + (t - start) - period * std::floor((t - start) / period);
    const auto next =
        std::ranges::upper_bound(rows, t, {}, [](const std::vector<Real>& row) { return row[0]; });
    if (next == rows.begin()) return rows.front()[1];
    const std::vector<Real>& a = *(next - 1);
    // Behind the last row a period leads back to the first.
    const bool behind = next == rows.end();
    if (behind && (period == 0 || a[0] >= start + period)) return a[1];
    const Real t_b = behind ? start + period : (*next)[0], b = behind ? rows[0][1] : (*next)[1];
    return a[1] + (b - a[1]) * (t - a[0]) / (t_b - a[0]);
  };
  // Between two times the extremes are at rows or at the ends.
  const auto range = [rows, period, at](Real a, Real b) {
    const auto after = [&](Real t) {
      return std::ranges::upper_bound(rows, t, {}, [](const auto& row) { return row[0]; });
    };
    OfTime::Range found{std::min(at(a), at(b)), std::max(at(a), at(b))};
    const Real first = period > 0 ? std::floor((a - rows[0][0]) / period) * period : 0;
    const Real last = period > 0 ? std::min(b - rows[0][0], first + 2 * period) : first;
    for (Real turn = first; turn <= last; turn += period > 0 ? period : 1)
      for (auto row = after(a - turn); row != rows.end() && (*row)[0] + turn < b; ++row)
        found = {std::min(found[0], (*row)[1]), std::max(found[1], (*row)[1])};
    return found;
  };
  return {at, range};
}

std::string doubt_about(const std::vector<std::vector<Real>>& rows, Real period, Real end) {
  constexpr Real hardly = 0.01, jump = 0.01;  // of all times, and of the range of the values
  const Real first = rows.front()[0], last = rows.back()[0];
  const auto [least, most] = std::ranges::minmax(rows, {}, [](const auto& row) { return row[1]; });
  const Real range = most[1] - least[1];
  if (range == 0) return "";
  if (end > 0 && end < hardly * (last - first))
    return print("its times go from %g to %g, and the run to t = %g: are both in the same units?",
                 first, last, end);
  const Real a = rows.back()[1], b = rows.front()[1];
  // Rounding may part the period from the times.
  if (period == 0 || last - first < (1 - 1e-9) * period) return "";
  const Real soonest = first - period * (std::ceil(first / period) - 1);  // after t = 0
  if (end > soonest && std::abs(a - b) > jump * range)
    return print(
        "its values jump from %g to %g after each period of %g, where its last row and "
        "its first meet: should the last row repeat the first?",
        a, b, period);
  return "";
}

}  // namespace fsi
