#pragma once
// Solids as signed distances: functions from a point to a length, negative inside.

#include <functional>
#include <limits>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi::shapes {

/// Distance to the surface, negative inside. It must have the right sign and |f(a) - f(b)| <= |a -
/// b|. A user may give a lambda; if it is no distance, divide it by a bound of its gradient.
using Shape = std::function<Real(const Vec3&)>;

/// Larger than any distance.
constexpr Real infinity = std::numeric_limits<Real>::infinity();

// Each shape below is centred at the origin with its axis of revolution along x. A 2-D run takes
// the section with the plane z = 0. A sphere is a disc, a torus is a pair of discs, a cylinder is a
// rectangle. Give `ellipsoid` and `box` an infinite extent along z there. Lengths must be positive
// (Error{input}), infinite only where it is said.

/// Ball; exact distance.
Shape sphere(Real radius);

/// x^2/a^2 + y^2/b^2 + z^2/c^2 <= 1 with semi_axes (a, b, c), each may be infinite (not all);
/// exact distance by Newton's iteration for the foot point.
Shape ellipsoid(const Vec3& semi_axes);

/// Solid cylinder of that height along x (-height/2 to height/2), flat ends; height may be
/// infinite. Exact distance.
Shape cylinder(Real radius, Real height = infinity);

/// A short cylinder.
inline Shape disk(Real radius, Real height) { return cylinder(radius, height); }

/// Ring about x: tube of radius `minor` around the circle of radius `major`. Exact distance.
Shape torus(Real major, Real minor);

/// Points within `radius` of the segment of that length along x. Exact distance.
Shape capsule(Real radius, Real length);

/// Sides along x, y, z of full lengths `sides`, each may be infinite. Exact distance.
Shape box(const Vec3& sides);

/// The shape moved by `offset`.
Shape translate(Shape shape, const Vec3& offset);

/// The shape turned about the line through the origin along `axis` by `angle` radians,
/// right-handed.
Shape rotate(Shape shape, const Vec3& axis, Real angle);

/// The shape turned by the smallest angle that brings the x axis to `axis`.
Shape align(Shape shape, const Vec3& axis);

/// The union. The distance is exact outside, a lower bound of its size inside.
Shape unite(std::vector<Shape> parts);

// Measures for comparison: volumes of the shapes above, and areas of their plane sections z = 0.
/// The circle's number.
constexpr Real pi = 3.14159265358979323846;
///@{
/// Exact volume (of the disc: area) of the shape of that name.
constexpr Real sphere_volume(Real radius) { return 4 * pi / 3 * radius * radius * radius; }
constexpr Real disc_area(Real radius) { return pi * radius * radius; }
constexpr Real ellipsoid_volume(const Vec3& a) { return 4 * pi / 3 * a.x * a.y * a.z; }
constexpr Real cylinder_volume(Real radius, Real height) { return pi * radius * radius * height; }
constexpr Real torus_volume(Real major, Real minor) { return 2 * pi * pi * major * minor * minor; }
constexpr Real capsule_volume(Real radius, Real length) {
  return sphere_volume(radius) + cylinder_volume(radius, length);
}
constexpr Real box_volume(const Vec3& sides) { return sides.x * sides.y * sides.z; }
///@}

}  // namespace fsi::shapes
