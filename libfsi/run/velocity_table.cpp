#include "libfsi/run/velocity_table.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/mesh/messages.hpp"
#include "libfsi/operators/least_squares.hpp"

namespace fsi {
namespace {

std::array<Real, 3> key_of(const Vec3& x) { return {x.x, x.y, x.z}; }

/// Collective. The normal of a patch in one plane; zero if it is curved.
Vec3 flat_normal(const Mesh& mesh, const Patch& patch) {
  constexpr Real flat = 0.999;  // of the area, as seen along the normal
  const auto [S, size] = area_of(patch, mesh);
  return norm(S) > flat * size ? S / norm(S) : Vec3{};
}

}  // namespace

VelocityTable::VelocityTable(std::string name, std::vector<Row> rows)
    : name_(std::move(name)), rows_(std::move(rows)) {
  require(!rows_.empty(), name_ + " has no rows");
  std::ranges::sort(rows_, {}, [](const Row& row) { return key_of(row.x); });
  for (std::size_t i = 1; i < rows_.size(); ++i)
    require(rows_[i].x != rows_[i - 1].x || rows_[i].u == rows_[i - 1].u,
            name_ + " has two velocities at " + text_of(rows_[i].x) +
                "; a file holds those of one time, and velocity_factor makes them change");
  const auto same = std::ranges::unique(rows_, {}, &Row::x);
  rows_.erase(same.begin(), same.end());
  given_ = rows_;
  set_directions({}, 3);
}

void VelocityTable::set_directions(const Vec3& normal, int dim) {
  Vec3 low = rows_[0].x, high = low, mean;
  for (const Row& row : rows_) {
    mean += row.x / static_cast<Real>(rows_.size());
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], row.x[k]), high[k] = std::max(high[k], row.x[k]);
  }
  extent_ = norm(high - low);
  SymTensor moments, in_plane;
  for (const Row& row : rows_) {
    Vec3 r = row.x - mean;
    if (dim < 3) r.z = 0;
    moments += square(r), in_plane += square(r - dot(r, normal) * normal);
  }
  // Layers along the patch are one, and so are those of any direction if the patch is not flat.
  constexpr Real layered = 4e-4, flat = 1e-6;  // of the largest moment
  axes_.clear();
  const auto add = [&](Real, const Vec3& e) { axes_.push_back(e); };
  if (normal == Vec3{}) {
    for_told_directions(moments, layered, add);
  } else {
    for_told_directions(in_plane, flat, add);
    if (dot(normal, dot(moments, normal)) > layered * trace(moments)) axes_.push_back(normal);
  }
  merge_layers();
  splines_.assign(rows_.size(), {});
  known_.clear();
}

// Points that differ across the directions of the table alone, such as two layers of a thin
// profile, are one: their mean.
void VelocityTable::merge_layers() {
  constexpr Real same = 1e-6;  // of the extent
  const auto along = [&](const Row& row) { return local(row.x).x; };
  std::ranges::sort(rows_, {}, along);
  std::vector<Row> merged;
  std::vector<char> taken(rows_.size(), 0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (taken[i] != 0) continue;
    Row sum{};
    Real count = 0;
    for (std::size_t j = i; j < rows_.size(); ++j) {
      if (along(rows_[j]) - along(rows_[i]) > same * extent_) break;
      if (taken[j] != 0 || norm(local(rows_[j].x - rows_[i].x)) > same * extent_) continue;
      sum.x += rows_[j].x, sum.u += rows_[j].u, count += 1, taken[j] = 1;
    }
    merged.push_back({sum.x / count, sum.u / count});
  }
  rows_ = std::move(merged);
}

Vec3 VelocityTable::local(const Vec3& x) const {
  Vec3 s;
  for (std::size_t k = 0; k < axes_.size(); ++k) s[static_cast<int>(k)] = dot(axes_[k], x);
  return s;
}

std::size_t VelocityTable::nearest(const Vec3& x) const {
  const auto away = [&](const Row& row) { return norm2(row.x - x); };
  return static_cast<std::size_t>(std::ranges::min_element(rows_, {}, away) - rows_.begin());
}

const Spline& VelocityTable::around(std::size_t k) const {
  constexpr std::size_t enough = 24;
  if (splines_[k]) return *splines_[k];
  std::vector<Row> near = rows_;
  const auto away = [&](const Row& row) {
    return std::pair(norm2(row.x - rows_[k].x), key_of(row.x));
  };
  for (std::size_t n = std::min(enough, near.size());; n = std::min(2 * n, near.size())) {
    std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(n), {}, away);
    std::vector<Spline::Point> points;
    for (std::size_t i = 0; i < n; ++i)
      points.push_back({local(near[i].x - rows_[k].x), near[i].u});
    Spline spline(std::move(points), static_cast<int>(axes_.size()));
    if (n == near.size() || spline.tells_slope()) return splines_[k].emplace(std::move(spline));
  }
}

std::string VelocityTable::fit_to(const Mesh& mesh, const Patch& patch) {
  if (extent_ == 0) return "";
  rows_ = given_;
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
  for (int i = 0; i < 3; ++i) high[i] = global_max(high[i]), low[i] = global_min(low[i]);
  const Vec3 across = high - low;
  farthest = global_max(farthest);
  // A profile along a line is valid, and so is one table for inlets far apart.
  constexpr Real beyond = 10, wider = 100;
  const bool far = farthest > beyond * extent_;
  const bool one =
      global_min(first) == global_max(last) && norm(across) > 0 && extent_ > wider * norm(across);
  const std::string its = name_ + ": its places, the first of them " + text_of(rows_[0].x) + ", ";
  require(!far, its + "do not reach patch \"" + patch.name + "\"; are both in the same units?");
  require(!one, its + "are far wider than patch \"" + patch.name +
                    "\": all of its faces are nearest to one of them; are both in the same units?");
  constexpr Real rounding = 0.01, mostly = 0.4;  // of the width, of the places
  const auto within = [&](Real margin) {
    std::vector<Row> rows;
    for (const Row& row : rows_) {
      bool in = true;
      for (int i = 0; i < 3; ++i)
        in = in && row.x[i] >= low[i] - margin && row.x[i] <= high[i] + margin;
      if (in) rows.push_back(row);
    }
    return rows;
  };
  const Real margin = rounding * norm(across);
  const bool others = static_cast<Real>(within(margin + least_distance(low, high)).size()) <
                      mostly * static_cast<Real>(rows_.size());
  const std::string told = others ? tell_of_width(mesh, patch) : "";
  rows_ = within(1.5 * farthest + margin);  // never empty: each face has a place that near
  set_directions(flat_normal(mesh, patch), mesh.dim);
  return others ? told : tell_of_width(mesh, patch);
}

// Of a table that lies before or behind the patch, the distance between both.
Real VelocityTable::least_distance(const Vec3& low, const Vec3& high) const {
  Real least = std::numeric_limits<Real>::infinity();
  for (const Row& row : rows_) {
    Real away = 0;
    for (int i = 0; i < 3; ++i) away = std::max({away, low[i] - row.x[i], row.x[i] - high[i]});
    least = std::min(least, away);
  }
  return least;
}

std::string VelocityTable::tell_of_width(const Mesh& mesh, const Patch& patch) const {
  constexpr Real odd = 2, none = std::numeric_limits<Real>::infinity();
  for (const Vec3& axis : axes_) {
    Real low = none, high = -none, first = none, last = -none;
    for (const Row& row : rows_)
      low = std::min(low, dot(axis, row.x)), high = std::max(high, dot(axis, row.x));
    for (Index f = patch.begin; f < patch.end; ++f)
      for (const Index p : mesh.face_points[f]) {
        const Real at = dot(axis, mesh.points[p]);
        first = std::min(first, at), last = std::max(last, at);
      }
    const Real table = high - low, width = global_max(last) - global_min(first);
    if (width > 0 && (table > odd * width || odd * table < width))
      return name_ + print(": its places span %.3g, where patch ", table) + patch.name +
             print(
                 " spans %.3g: between and beyond them the velocity is guessed, see the flow "
                 "rate; are both in the same units?",
                 width);
  }
  return "";
}

Vec3 VelocityTable::operator()(const Vec3& x) const {
  const auto [known, is_new] = known_.try_emplace(key_of(x));
  if (!is_new) return known->second;
  // A small table has one spline, so that the velocity is smooth.
  constexpr std::size_t small = 24;
  const std::size_t k = rows_.size() <= small ? 0 : nearest(x);
  return known->second = around(k)(local(x - rows_[k].x));
}

}  // namespace fsi
