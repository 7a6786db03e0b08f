#pragma once
// How far the solid is stretched in the x-y plane, and which way.

#include "libfsi/solver/body.hpp"

namespace fsi {

/// Of the ellipse with the second moments of the solid in the x-y plane, half-axes a >= b.
struct Taylor {
  Real deformation = 0;  ///< D = (a - b) / (a + b)   [Taylor34]
  Real angle = 0;        ///< of a to the x axis, degrees, above -90 and up to 90; 0 for a circle
};

/// Collective. From the moments of the solid behind its planes, moved on by `later`. They are exact
/// for the planes and of second order in the cell size for the solid:
///   dM/dt = integral of u x + x u, M = integral of x x.
/// Where planes of symmetry cut the solid, of the whole of it, with its images. u: of the cells.
/// about: a point in the solid next to which its parts are placed, near the
/// centroid.
Taylor taylor(const Body& body, const CellField<Vec3>& u, const Vec3& about, Real later);

}  // namespace fsi
