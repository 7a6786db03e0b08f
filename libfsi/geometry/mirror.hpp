#pragma once
// Mirror images in a plane of symmetry.

#include "libfsi/core/types.hpp"

namespace fsi::geometry {

/// A plane of symmetry.
struct Mirror {
  Vec3 x;  ///< a point of the plane
  Vec3 n;  ///< unit normal

  /// Image of a direction.
  Vec3 of_direction(const Vec3& v) const { return v - (2 * dot(v, n)) * n; }
  /// Image of a point.
  Vec3 of_point(const Vec3& p) const { return p - (2 * dot(p - x, n)) * n; }
  /// The point of the plane below p: the middle between p and its image.
  Vec3 foot(const Vec3& p) const { return p - dot(p - x, n) * n; }
};

}  // namespace fsi::geometry
