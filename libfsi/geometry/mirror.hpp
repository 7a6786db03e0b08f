#pragma once
// Mirror images in a plane of symmetry.

#include <cmath>

#include "libfsi/core/types.hpp"

namespace fsi::geometry {

/// The plane through x with the unit normal n.
struct Mirror {
  Vec3 x, n;

  /// Image of a direction.
  Vec3 of_direction(const Vec3& v) const { return v - (2 * dot(v, n)) * n; }
  /// Image of a point.
  Vec3 of_point(const Vec3& p) const { return p - (2 * dot(p - x, n)) * n; }
  /// The point of the plane below p: the middle between p and its image.
  Vec3 foot(const Vec3& p) const { return p - dot(p - x, n) * n; }
  /// Whether the other is the same plane: parallel to a part `level` of a radian, and with its
  /// point within `touching` of this one.
  bool is_same(const Mirror& other, Real level, Real touching) const {
    return norm2(n - dot(n, other.n) * other.n) < level * level &&
           std::abs(dot(other.x - x, n)) < touching;
  }
};

}  // namespace fsi::geometry
