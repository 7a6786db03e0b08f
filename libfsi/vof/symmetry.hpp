#pragma once
// The planes of symmetry that cut a solid.

#include <functional>
#include <vector>

#include "libfsi/geometry/mirror.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::vof {

/// Planes that cut a solid. Images in planes at right angles to each other complete the solid. At
/// other angles they never end, or they overlap.
struct CuttingPlanes {
  std::vector<geometry::Mirror> planes{};  ///< all at right angles to each other; else empty
  bool odd = false;  ///< whether the solid is cut, but not by planes at right angles alone
  /// [n_boundary] 1 for the faces of `mirrors` that lie in a plane that cuts the solid, at any
  /// angle to others; all 0 if a curved patch cuts it.
  std::vector<char> faces{};
};

/// Collective. The planes with faces of `mirrors` beyond which a part of the solid lies; a solid
/// that only touches a plane is not cut by it. A patch may hold several planes, and several patches
/// may lie in one. A patch is curved if a face beside those in a plane turns by less than 30
/// degrees; a larger turn is an edge. distance: of x to the surface of the solid, negative inside.
CuttingPlanes cutting_planes(const std::function<Real(const Vec3&)>& distance, const Mesh& mesh,
                             const std::vector<Patch>& mirrors);

}  // namespace fsi::vof
