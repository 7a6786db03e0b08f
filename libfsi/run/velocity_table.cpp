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
  constexpr std::size_t around = 8;
  const Row& here = rows_[k];
  std::vector<Row> near;
  for (const Row& row : rows_)
    if (row.x != here.x) near.push_back(row);
  const std::size_t n = std::min(around, near.size());
  std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(n), {},
                            [&](const Row& row) { return norm2(row.x - here.x); });
  SlopeFit fit;
  for (std::size_t i = 0; i < n; ++i) fit.add(near[i].x - here.x, near[i].u - here.u);
  constexpr Real told = 1e-3;  // of the spread in the widest direction
  return slope_[k].emplace(fit.slope(told));
}

std::size_t VelocityTable::nearest(const Vec3& x) const {
  const auto away = [&](const Row& row) { return norm2(row.x - x); };
  return static_cast<std::size_t>(std::ranges::min_element(rows_, {}, away) - rows_.begin());
}

void VelocityTable::check(const Mesh& mesh, const Patch& patch) const {
  if (extent_ == 0) return;
  Real first = std::numeric_limits<Real>::infinity(), last = 0, farthest = 0;
  for (Index f = patch.begin; f < patch.end; ++f) {
    const std::size_t k = nearest(mesh.Cf[f]);
    first = std::min(first, static_cast<Real>(k)), last = std::max(last, static_cast<Real>(k));
    farthest = std::max(farthest, norm(mesh.Cf[f] - rows_[k].x));
  }
  const bool one = global_min(first) == global_max(last) && global_sum(patch.end - patch.begin) > 1;
  const bool far = global_max(farthest) > extent_ / 2;
  const std::string its = name_ + ": its places, the first of them " + text_of(rows_[0].x) + ", ";
  require(!far, its + "do not reach patch \"" + patch.name + "\"; are both in the same units?");
  require(!one, its + "are wider than patch \"" + patch.name +
                    "\": all of its faces are nearest to one of them; are both in the same units?");
}

Vec3 VelocityTable::operator()(const Vec3& x) const {
  const std::size_t k = nearest(x);
  return rows_[k].u + dot(slope(k), x - rows_[k].x);
}

}  // namespace fsi
