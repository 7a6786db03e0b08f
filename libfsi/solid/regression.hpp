#pragma once
// Slopes by least squares over the neighbours of a cell.

#include <cmath>

#include "libfsi/core/types.hpp"

namespace fsi::solid {

/// The inverse of M = sum w r (x) r, in two dimensions of its in-plane part. Where M does not tell
/// a direction (fewer neighbours than unknowns) M is raised by a hundredth of its mean eigenvalue:
/// the slope along that direction tends to zero. M: not zero.
inline Tensor inverse_of_moments(Tensor M, int dim) {
  if (dim == 2) M.zz = 1;
  const Real mean = dim == 2 ? (M.xx + M.yy) / 2 : trace(M) / 3;
  if (!(det(M) > 1e-3 * std::pow(mean, dim))) {
    const Real more = 1e-2 * mean;
    M.xx += more, M.yy += more, M.zz += more;
  }
  return inverse(M);
}

}  // namespace fsi::solid
