#pragma once
// The limiter Ko of the transport of psi and of the map.

#include <algorithm>
#include <cmath>

#include "libfsi/core/types.hpp"

namespace fsi::solid {

/// a . b.
inline Real product(const Vec3& a, const Vec3& b) { return dot(a, b); }
/// a : b.
inline Real product(const SymTensor& a, const SymTensor& b) { return contract(a, b); }

/// Half a step from the upwind value, limited [Koren93]:
///   Ko(varrho) step / 2 + Ko(varrho) / (2 + varrho) min(1, |step| / |rest|) rest,
///   Ko(varrho) = max(0, min(2 varrho, (2 + varrho) / 3, 2)),
///   varrho = 2 q - 1,  q = slope : step / step : step,  rest = slope - q step.
/// step: downwind less upwind value. slope: grad . d with the gradient of the upwind cell. A
/// vector and a tensor are limited as a whole, so that the value does not depend on the axes. On
/// smooth profiles of a uniform mesh it is of third order.
template <class T>
T koren(const T& step, const T& slope) {
  const Real s2 = product(step, step);
  const Real along = product(slope, step);
  const Real upwind = 2 * along - s2;  // varrho s2
  if (!(upwind > 0)) return {};
  const Real varrho = upwind / s2;
  const Real Ko = std::min({2 * varrho, (2 + varrho) / 3, Real{2}});
  const T rest = slope - (along / s2) * step;
  const Real r2 = product(rest, rest);
  const Real part = r2 > s2 ? std::sqrt(s2 / r2) : 1;
  return (Ko / 2) * step + (part * Ko / (2 + varrho)) * rest;
}

}  // namespace fsi::solid
