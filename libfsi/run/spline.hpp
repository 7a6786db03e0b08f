#pragma once
// A smooth interpolation between places without order.

#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi {

/// The spline of least bending through the velocities u_i at the places s_i [Duchon77],
///
///   u(s) = sum_i w_i |s - s_i|^3 + sum_j a_j p_j(s),   sum_i w_i p_j(s_i) = 0.
///
/// The p_j are 1, the components of s and, where there are at least as many places as such terms,
/// their products. A term that the places do not tell from those before is left out. It is exact
/// for a velocity of these terms, so for a parabola.
class Spline {
 public:
  /// A place, with zeros behind its first `dim` components, and the velocity there.
  struct Point {
    Vec3 s;  ///< place
    Vec3 u;  ///< velocity
  };
  /// points: at least one; no place twice.
  Spline(std::vector<Point> points, int dim);

  /// u(s).
  Vec3 operator()(const Vec3& s) const;
  /// Whether 1 and all components of s are among the terms.
  bool tells_slope() const;

 private:
  /// Keeps the terms that the points tell apart.
  void choose_terms();
  void solve();

  std::vector<Point> points_;  // in units of size_, from the first of them
  int dim_;
  Vec3 origin_;
  Real size_ = 1;           // the largest distance from the first point
  std::vector<int> terms_;  // numbers of the p_j
  std::vector<Vec3> w_, a_;
};

}  // namespace fsi
