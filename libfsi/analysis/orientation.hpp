#pragma once
// The orientation of a solid.

#include <array>

#include "libfsi/analysis/surface.hpp"

namespace fsi::analysis {

/// Second moments of the surface about the centroid, and the axis they give.
struct Orientation {
  SymTensor gyration{};         ///< second moments
  std::array<Real, 3> value{};  ///< eigenvalues, ascending; in 2-D the two in the plane, then 0
  Vec3 n{};                     ///< axis of the smallest: of revolution, for a disc or a ring
  Vec3 longest{};               ///< axis of the largest: of revolution, for an egg or a capsule
};

/// Collective. Area-weighted gyration tensor of the surface about `centroid`,
///   G = (1/A) integral (x - x_c)(x - x_c) dA,   [Matsumiya25] (21),
/// where the paper takes the mean over points. Facets differ in size. n and `longest` are the
/// eigenvectors of the smallest and the largest eigenvalue, with the signs that agree with those of
/// `previous` (zero: x >= 0). Zero everywhere where there is no surface.
Orientation orientation(const Surface& surface, const Vec3& centroid,
                        const Orientation& previous = {});

/// Between a line along v and the x axis, degrees, 0 to 90; v is a unit vector or 0.
Real angle_to_x(const Vec3& v);

/// Angle in the x-y plane from a line along `from` to one along `to`, in degrees, above -90 and up
/// to 90. It is 0 where one of them is within a thousandth of the z axis, about which it may turn
/// freely.
Real turn_about_z(const Vec3& from, const Vec3& to);

}  // namespace fsi::analysis
