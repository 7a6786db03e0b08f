#include "libfsi/run/samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace fsi {
namespace {

/// Where t lies on the way from one time to another; 1 where they are the same.
Real part(Real t, Real from, Real to) { return to > from ? (t - from) / (to - from) : 1; }

/// (1 - w) before + w after, as it is for that column.
Real mixed(Real before, const Entry& after, Real w, Real w_shape) {
  if (after.course == Course::step || !std::isfinite(before)) return after.value;
  const bool energy = after.course == Course::energy;
  if (energy || after.course == Course::shape) w = w_shape;
  if (energy) return std::max((1 - w) * before + w * after.value, Real{0});
  if (after.course != Course::half_turn) return (1 - w) * before + w * after.value;
  const Real way = std::remainder(after.value - before, 180);
  const Real angle = after.value - (1 - w) * way;
  return angle > 90 ? angle - 180 : angle <= -90 ? angle + 180 : angle;
}

/// Makes the column `first` and the two behind it a unit vector again, and `angle_name` its angle
/// to the x axis in degrees.
void set_axis(std::vector<Real>& values, const std::vector<Entry>& entries, const char* first,
              const char* angle_name) {
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(entries, name, &Entry::name) -
                                    entries.begin());
  };
  const std::size_t n = at(first), angle = at(angle_name);
  if (angle >= values.size() || n + 2 >= values.size()) return;
  const Vec3 axis{values[n], values[n + 1], values[n + 2]};
  const Real size = norm(axis);
  if (!(size > 0)) return;
  for (int i = 0; i < 3; ++i) values[n + static_cast<std::size_t>(i)] = axis[i] / size;
  values[angle] = std::acos(std::min(std::abs(axis.x) / size, Real{1})) * (180 / std::numbers::pi);
}

}  // namespace

std::vector<Real> between(const Row& before, const Row& after, Real t) {
  const bool whole = before.entries.size() == after.entries.size();
  const Real w = std::clamp(part(t, before.t, after.t), Real{0}, Real{1});
  const Real w_shape = part(t, before.t_shape, after.t_shape);
  std::vector<Real> values;
  for (std::size_t i = 0; i < after.entries.size(); ++i)
    values.push_back(whole ? mixed(before.entries[i].value, after.entries[i], w, w_shape)
                           : after.entries[i].value);
  if (whole) {
    set_axis(values, after.entries, "nx", "angle");
    set_axis(values, after.entries, "lx", "long_angle");
  }
  values[0] = t;
  return values;
}

std::vector<Real> Samples::due(Real t) {
  return each_step_ ? std::vector<Real>{t} : every_.reached(t);
}

Real Samples::not_past(Real t) const {
  return each_step_ || !held_.empty() ? std::numeric_limits<Real>::max() : every_.next(t);
}

std::vector<Real> Samples::row(std::size_t i, const Row& now, Real t) const {
  return between(i < held_.size() ? held_[i] : Row{}, now, t);
}

std::vector<std::vector<Real>> Samples::rows(const std::vector<Row>& now, Real t) const {
  const auto energy = [&](std::size_t i) {
    return std::ranges::find(now[i].entries, "elastic_energy", &Entry::name) -
           now[i].entries.begin();
  };
  std::vector<std::vector<Real>> all{row(0, now[0], t)};
  Real sum = 0;
  for (std::size_t i = 1; i < now.size(); ++i) {
    const bool gone = now[i].entries.empty();
    all.push_back(gone ? std::vector<Real>{} : row(i, now[i], t));
    if (!gone) sum += all[i][static_cast<std::size_t>(energy(i))];
  }
  all[0][static_cast<std::size_t>(energy(0))] = sum;
  return all;
}

std::string Samples::text() const {
  std::string text;
  const auto add = [&](Real value) {
    std::array<char, 32> word{};
    std::snprintf(word.data(), word.size(), "%.17g ", value);
    text += word.data();
  };
  for (const Row& row : held_) {
    add(static_cast<Real>(row.entries.size())), add(row.t), add(row.t_shape);
    // Figures of the step alone depend on the machine and are never taken from here.
    for (const Entry& entry : row.entries) add(entry.course == Course::step ? 0 : entry.value);
  }
  return text.empty() ? "none" : text;
}

void Samples::resume(Real t, const std::string& text) {
  every_.resume(t);
  held_.clear();
  const char* at = text.c_str();
  const auto next = [&] {
    char* end = nullptr;
    const Real value = std::strtod(at, &end);
    const bool found = end != at;
    at = end;
    return found ? value : -1;
  };
  if (text == "none") return;
  for (Real size = next(); size >= 0; size = next()) {  // 0: of a solid that has left
    Row& row = held_.emplace_back();
    row.t = next(), row.t_shape = next();
    for (Real i = 0; i < size; ++i) row.entries.push_back({"", next()});
  }
}

}  // namespace fsi
