#pragma once
// The deformation of a torus: the measures of [Matsumiya25] section 3.2.

#include "libfsi/analysis/ellipse.hpp"
#include "libfsi/analysis/surface.hpp"

namespace fsi::analysis {

/// Axes that turn with the ring: xi = n its axis, zeta across, eta = xi x zeta.
struct RingFrame {
  /// Unit vectors.
  Vec3 zeta, eta, xi;
};

/// The frame of a ring with axis n. The previous zeta is turned the short way with the axis. At
/// first (zero) it is the z axis made perpendicular to n, or the y axis where n is along z. For a
/// ring tilted by an angle a in the x-y plane, n = (cos a, sin a, 0): zeta = z, eta = (sin a, -cos
/// a, 0), downstream in a flow along x.
RingFrame ring_frame(const Vec3& n, const Vec3& previous_zeta = {});

/// Shape of a ring. Aspect ratios are minor / major axis of the least-squares ellipse, 1 for a
/// circle, 0 where the cut is empty.
struct Ring {
  /// Cross-sections of the tube: in the meridian plane (eta, xi) on the side of eta and opposite,
  /// in the prime vertical plane (zeta, xi) on the side of zeta and opposite.
  Ellipse forward, back, right, left;
  /// Inner and outer outline of the ring in the direction of xi.
  Ellipse inner, outer;
  /// 180 degrees less the angle at the centroid between the centres of two opposite cross-sections;
  /// positive where they bend toward xi. Degrees; 0 for a flat ring.
  Real bending_meridian = 0, bending_prime = 0;
};

/// Collective. Measures the surface (3-D) of a ring about its centroid. Sections: a least-squares
/// ellipse (23) through the cut of the surface with each half plane that the axis xi bounds.
/// Outlines: the same through the least and the largest distance from the axis in such half planes
/// all around.
Ring ring(const Surface& surface, const Vec3& centroid, const RingFrame& frame);

}  // namespace fsi::analysis
