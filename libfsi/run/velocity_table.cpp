#include "libfsi/run/velocity_table.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/messages.hpp"
#include "libfsi/operators/least_squares.hpp"

namespace fsi {

VelocityTable::VelocityTable(std::string name, std::vector<Row> rows)
    : name_(std::move(name)), rows_(std::move(rows)), slope_(rows_.size()) {
  require(!rows_.empty(), name_ + " has no rows");
  Vec3 low = rows_[0].x, high = low;
  for (const Row& row : rows_)
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], row.x[k]), high[k] = std::max(high[k], row.x[k]);
  extent_ = norm(high - low);
}

const Tensor& VelocityTable::slope(std::size_t k) const {
  if (slope_[k]) return *slope_[k];
  const Row& here = rows_[k];
  std::vector<Row> near;
  for (const Row& row : rows_)
    if (row.x != here.x) near.push_back(row);
  std::ranges::sort(near, {}, [&](const Row& row) { return norm2(row.x - here.x); });
  const auto fit = [&](std::size_t n) {
    SlopeFit of_nearest;
    for (std::size_t i = 0; i < n; ++i) of_nearest.add(near[i].x - here.x, near[i].u - here.u);
    return of_nearest;
  };
  constexpr Real told = 0.02;  // of the spread in the widest direction
  const auto directions = [](const SlopeFit& of_nearest) {
    int count = 0;
    for_told_directions(of_nearest.M, told, [&](Real, const Vec3&) { ++count; });
    return count;
  };
  const int all = directions(fit(near.size()));
  std::size_t n = std::min<std::size_t>(8, near.size());
  while (n < near.size() && directions(fit(n)) < all) n = std::min(2 * n, near.size());
  return slope_[k].emplace(fit(n).slope(told));
}

std::size_t VelocityTable::nearest(const Vec3& x) const {
  const auto away = [&](const Row& row) { return norm2(row.x - x); };
  return static_cast<std::size_t>(std::ranges::min_element(rows_, {}, away) - rows_.begin());
}

void VelocityTable::check(const Mesh& mesh, const Patch& patch) const {
  if (extent_ == 0) return;
  constexpr Real none = std::numeric_limits<Real>::infinity();
  Real first = none, last = 0, farthest = 0;
  Vec3 low{none, none, none}, high = -1.0 * low;
  for (Index f = patch.begin; f < patch.end; ++f) {
    const std::size_t k = nearest(mesh.Cf[f]);
    first = std::min(first, static_cast<Real>(k)), last = std::max(last, static_cast<Real>(k));
    farthest = std::max(farthest, norm(mesh.Cf[f] - rows_[k].x));
    for (int i = 0; i < 3; ++i)
      low[i] = std::min(low[i], mesh.Cf[f][i]), high[i] = std::max(high[i], mesh.Cf[f][i]);
  }
  Vec3 across;
  for (int i = 0; i < 3; ++i) across[i] = global_max(high[i]) - global_min(low[i]);
  // A profile along a line is valid, and so is one table for inlets far apart.
  constexpr Real beyond = 10, wider = 100;
  const bool far = global_max(farthest) > beyond * extent_;
  const bool one =
      global_min(first) == global_max(last) && norm(across) > 0 && extent_ > wider * norm(across);
  const std::string its = name_ + ": its places, the first of them " + text_of(rows_[0].x) + ", ";
  require(!far, its + "do not reach patch \"" + patch.name + "\"; are both in the same units?");
  require(!one, its + "are far wider than patch \"" + patch.name +
                    "\": all of its faces are nearest to one of them; are both in the same units?");
}

Vec3 VelocityTable::operator()(const Vec3& x) const {
  const std::size_t k = nearest(x);
  return rows_[k].u + dot(slope(k), x - rows_[k].x);
}

}  // namespace fsi
