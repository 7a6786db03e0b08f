#include "libfsi/field/of_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fsi {
namespace {

Real width(const OfTime::Range& range) { return range[1] - range[0]; }

}  // namespace

// Samples at multiples of the golden ratio, whose distances are those of no period.
OfTime::Range OfTime::range(Real a, Real b) const {
  if (range_) return range_(a, b);
  constexpr int samples = 64;
  constexpr Real golden = 0.6180339887498949;
  Range range{std::min(at_(a), at_(b)), std::max(at_(a), at_(b))};
  for (int i = 1; i <= samples; ++i) {
    const Real value = at_(a + (i * golden - std::floor(i * golden)) * (b - a));
    range = {std::min(range[0], value), std::max(range[1], value)};
  }
  return range;
}

Real step_of(const OfTime& given, Real t, Real end) {
  constexpr Real change = 0.1, least = 1e-5, rounding = 1e-12;
  const OfTime::Range whole = given.range(0, std::max(end, t));
  const Real most = width(whole);
  if (!(most > rounding * std::max(std::abs(whole[0]), std::abs(whole[1])))) return end;
  Real dt = end;
  while (dt > least * end && width(given.range(t, t + dt)) > change * most) dt *= 0.75;
  return std::max(dt, least * end);
}

}  // namespace fsi
