#pragma once
// Which way the solid points.

#include <array>

#include "libfsi/analysis/surface.hpp"

namespace fsi::analysis {

/// Second moments of the surface about the centroid, and the axis they give.
struct Orientation {
  SymTensor gyration;           ///< second moments
  std::array<Real, 3> value{};  ///< eigenvalues, ascending; in 2-D the two in the plane, then 0
  Vec3 n;                       ///< axis of the smallest: of revolution, for a disc or a ring
  Real angle = 0;               ///< between n and the x axis, degrees, 0 to 90
};

/// Collective. Area-weighted gyration tensor of the surface about `centroid`,
///   G = (1/A) integral (x - x_c)(x - x_c) dA,   [Matsumiya25] (21),
/// where the paper takes the mean over points. Facets differ in size. The axis n is the eigenvector
/// of the smallest eigenvalue, with the sign that agrees with `previous` (zero: n.x >= 0).
/// Zero everywhere where there is no surface.
Orientation orientation(const Surface& surface, const Vec3& centroid, const Vec3& previous = {});

}  // namespace fsi::analysis
