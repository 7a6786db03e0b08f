#pragma once
// The limiter Ko of the transport of psi and of the map.

#include <algorithm>
#include <cmath>

#include "libfsi/core/types.hpp"

namespace fsi::solid {

/// Half a step from the upwind value, limited [Koren93]:
///   Ko(varrho) step / 2,   Ko(varrho) = max(0, min(2 varrho, (2 + varrho) / 3, 2)),
///   varrho = 2 slope / step - 1, the upwind over the downwind difference.
/// step: downwind less upwind value. slope: grad . d with the gradient of the upwind cell. On
/// smooth profiles of a uniform mesh it is of third order.
inline Real koren(Real step, Real slope) {
  const Real upwind = 2 * slope - step;
  if (upwind * step <= 0) return 0;
  const Real size =
      std::min({2 * std::abs(upwind), std::abs(step + 2 * slope) / 3, 2 * std::abs(step)});
  return std::copysign(size / 2, step);
}

/// The same component by component.
inline Vec3 koren(const Vec3& step, const Vec3& slope) {
  return {koren(step.x, slope.x), koren(step.y, slope.y), koren(step.z, slope.z)};
}
/// The same component by component.
inline SymTensor koren(const SymTensor& step, const SymTensor& slope) {
  return {koren(step.xx, slope.xx), koren(step.xy, slope.xy), koren(step.xz, slope.xz),
          koren(step.yy, slope.yy), koren(step.yz, slope.yz), koren(step.zz, slope.zz)};
}

}  // namespace fsi::solid
