#pragma once
// The ellipse that fits points in a plane.

#include <array>

#include "libfsi/core/parallel.hpp"
#include "libfsi/core/types.hpp"

namespace fsi::analysis {

/// Centre, half axes and the angle of the major one to the first coordinate axis, radians.
struct Ellipse {
  /// Centre.
  Real x = 0, y = 0;
  /// Half axes.
  Real major = 0, minor = 0;
  Real angle = 0;      ///< of the major axis, radians
  bool found = false;  ///< false: fewer than five points, or points on a line or hyperbola

  /// minor / major in (0, 1]; 0 where none was found.
  Real aspect() const { return found ? minor / major : 0; }
};

/// Weighted sums of powers of the coordinates, x^i y^j with i + j <= 4: all that a fit needs, so
/// points can lie on any rank. Coordinates should be relative to a point near the middle of the
/// points.
class PlaneMoments {
 public:
  /// Adds a point.
  void add(Real x, Real y, Real weight);

  /// Collective. Ellipses of several sets of points in one exchange.
  template <std::size_t n>
  static std::array<Ellipse, n> fit(const std::array<PlaneMoments, n>& sets) {
    std::array<Sum, n * count> parts;
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < count; ++i) parts[k * count + i] = sets[k].sums_[i];
    }
    std::array<Real, n * count> totals{};
    Sum::totals(totals, parts);
    std::array<Ellipse, n> result;
    for (std::size_t k = 0; k < n; ++k) {
      std::array<Real, count> mine{};
      for (std::size_t i = 0; i < count; ++i) mine[i] = totals[k * count + i];
      result[k] = solve(mine);
    }
    return result;
  }

 private:
  static constexpr std::size_t count = 15;
  static Ellipse solve(const std::array<Real, count>& moments);

  std::array<Sum, count> sums_;  // 1, x, y, xx, xy, yy, xxx, ...: by degree, then by power of y
};

}  // namespace fsi::analysis
