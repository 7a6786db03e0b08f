#pragma once
// Volume, first and second moments of a cell and of the part of it below a plane.

#include "libfsi/geometry/cut.hpp"
#include "libfsi/geometry/mirror.hpp"

namespace fsi::geometry {

/// Integrals of 1, x and x x over a body (2-D: an area), x from the origin of the coordinates.
struct Moments {
  Real volume = 0;   ///< integral of 1
  Vec3 first;        ///< integral of x
  SymTensor second;  ///< integral of x x
};

/// The same body with the origin of the coordinates moved to -shift: every x becomes x + shift.
Moments shifted(const Moments& m, const Vec3& shift);

/// Of the body's image in a mirror.
Moments image(const Moments& m, const Mirror& mirror);

/// Moments of the whole cell.
Moments moments(const Polytope& cell);

/// Of its part below the plane; exact.
Moments moments_below(const Polytope& cell, const Plane& plane);

}  // namespace fsi::geometry
