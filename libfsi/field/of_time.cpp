#include "libfsi/field/of_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fsi {
namespace {

Real width(const OfTime::Range& range) { return range[1] - range[0]; }

}  // namespace

Real golden(int k) {
  constexpr Real ratio = 0.6180339887498949;
  return k * ratio - std::floor(k * ratio);
}

OfTime::Range OfTime::range(Real a, Real b) const {
  if (range_) return range_(a, b);
  constexpr int samples = 64;
  Range range{std::min(at_(a), at_(b)), std::max(at_(a), at_(b))};
  for (int i = 1; i <= samples; ++i) {
    const Real value = at_(a + golden(i) * (b - a));
    range = {std::min(range[0], value), std::max(range[1], value)};
  }
  return range;
}

Real step_of(const OfTime& given, Real t, Real end) {
  constexpr Real rounding = 1e-12;
  const OfTime::Range whole = given.range(0, std::max(end, t));
  const Real most = width(whole);
  if (!(most > rounding * std::max(std::abs(whole[0]), std::abs(whole[1])))) return end;
  return step_of(given, most, t, end);
}

// Of end, 0.75 end, 0.75^2 end, ... one that will do while the one before it does not.
Real step_of(const OfTime& given, Real most, Real t, Real end) {
  constexpr Real change = 0.05, least = 1e-5, shorter = 0.75;
  // Half of it before t: a jump of which a short step took the first part is not followed by a long
  // step that takes the rest.
  constexpr Real changed = change / 2;
  constexpr Real growth = 1.25;
  constexpr int before = 8;  // steps looked back on
  const auto length = [&](int k) { return std::max(std::pow(shorter, k), least) * end; };
  int does = 0, not_yet = -1;
  while (length(does) > least * end) ++does;
  while (does - not_yet > 1) {
    const int middle = (does + not_yet) / 2;
    Real begin = t, dt = length(middle);
    bool well = width(given.range(t, std::min(t + dt, std::max(end, t)))) <= change * most;
    for (int i = 0; i < before && well; ++i) {
      const Real until = begin;
      dt /= growth, begin = std::max(begin - dt, Real{0});
      well = width(given.range(begin, until)) <= changed * most;
    }
    (well ? does : not_yet) = middle;
  }
  return length(does);
}

}  // namespace fsi
