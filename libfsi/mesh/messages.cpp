#include "libfsi/mesh/messages.hpp"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

#include "libfsi/core/error.hpp"

namespace fsi {
namespace {

/// Insertions, deletions and changes that lead from a to b.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

void refuse(const std::string& sentence) { throw Error(ErrorKind::input, sentence); }

std::string text_of(const Vec3& x) {
  std::ostringstream out;
  out << '(' << x.x << ", " << x.y << ", " << x.z << ')';
  return out.str();
}

std::string text_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string nearest(const std::string& name, const std::vector<std::string>& names) {
  std::string best;
  std::size_t fewest = name.size() / 2 + 1;
  for (const std::string& other : names) {
    if (const std::size_t n = edits(name, other); n < fewest) fewest = n, best = other;
  }
  return best;
}

}  // namespace fsi
