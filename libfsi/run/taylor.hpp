#pragma once
// The deformation of the solid in the x-y plane, and its direction.

#include "libfsi/solver/body.hpp"

namespace fsi {

/// Of the ellipse with the second moments of the solid in the x-y plane, half-axes a >= b.
struct Taylor {
  Real deformation = 0;  ///< D = (a - b) / (a + b)   [Taylor34]
  Real angle = 0;        ///< of a to the x axis, degrees, above -90 and up to 90; 0 for a circle
};

/// Collective. From the moments of the solid behind its planes, advanced by `later`. They are exact
/// for the planes and of second order in the cell size for the solid:
///   dM/dt = integral of u x + x u, M = integral of x x.
/// If planes of symmetry cut the solid, it is that of the whole solid with its images. u: of the
/// cells. about: a point in the solid near the centroid, next to which its parts are placed.
Taylor taylor(const Body& body, const CellField<Vec3>& u, const Vec3& about, Real later);

}  // namespace fsi
