#include "libfsi/mesh/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

/// Squares of the grid along one direction of the section.
struct Ruler {
  Vec3 direction;
  Real low = 0, width = 0;
  std::int32_t count = 1;

  std::int32_t place(const Vec3& x) const {
    if (count == 1) return 0;
    const Real at = (dot(direction, x) - low) / width;
    return std::clamp(static_cast<std::int32_t>(at), 0, count - 1);
  }
};

/// Two directions normal to the axis and to each other.
std::array<Vec3, 2> section_of(const Vec3& axis) {
  int least = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(axis[k]) < std::abs(axis[least])) least = k;
  }
  Vec3 unit;
  unit[least] = 1;
  Vec3 first = unit - axis * dot(axis, unit);
  first = first / norm(first);
  return {first, cross(axis, first)};
}

/// Collective. The ruler from the first middle to the last. The mean extent of the cells is summed
/// in whole parts of that length, so that it does not depend on who holds which cell.
Ruler ruler_of(const CellList& here, const Vec3& direction, GlobalIndex n_cells) {
  constexpr Real fine = 1e6, most = 3e4;
  Real low = std::numeric_limits<Real>::max(), high = -low;
  for (Index c = 0; c < here.n_cells(); ++c) {
    const Real x = dot(direction, middle(here, c));
    low = std::min(low, x), high = std::max(high, x);
  }
  low = global_min(low), high = global_max(high);
  const Real length = high - low;
  if (!(length > 0)) return {direction, low};
  GlobalIndex sum = 0;
  for (Index c = 0; c < here.n_cells(); ++c) {
    Real least = std::numeric_limits<Real>::max(), largest = -least;
    for (const Index p : here.corners[c]) {
      const Real x = dot(direction, here.points[p]);
      least = std::min(least, x), largest = std::max(largest, x);
    }
    sum += std::llround(fine * std::min(1.0, (largest - least) / length));
  }
  const Real extent = static_cast<Real>(global_sum(sum)) / static_cast<Real>(n_cells) / fine;
  const Real squares = std::clamp(std::ceil(2 / extent), 1.0, most);
  return {direction, low, length / squares, static_cast<std::int32_t>(squares)};
}

}  // namespace

Vec3 middle(const CellList& list, Index cell) {
  Vec3 sum;
  for (const Index p : list.corners[cell]) sum += list.points[p];
  return sum / static_cast<Real>(list.corners[cell].size());
}

std::vector<std::int32_t> columns_of(const CellList& here, const Vec3& along) {
  const GlobalIndex n_cells = global_sum(GlobalIndex{here.n_cells()});
  const auto [first, second] = section_of(along / norm(along));
  const Ruler x = ruler_of(here, first, n_cells), y = ruler_of(here, second, n_cells);
  std::vector<std::int32_t> columns;
  columns.reserve(here.types.size());
  for (Index c = 0; c < here.n_cells(); ++c) {
    const Vec3 centre = middle(here, c);
    columns.push_back(x.place(centre) * y.count + y.place(centre));
  }
  return columns;
}

}  // namespace fsi
