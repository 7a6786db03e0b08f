#pragma once
// The planes of symmetry that cut a solid.

#include <functional>
#include <vector>

#include "libfsi/geometry/mirror.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::vof {

/// Planes that cut a solid. The images in planes at right angles to each other make the solid
/// whole; those in other planes go on and on, or overlap.
struct CuttingPlanes {
  std::vector<geometry::Mirror> planes{};  ///< all at right angles; empty where they are not
  bool odd = false;  ///< whether the solid is cut, but not by planes at right angles alone
  /// [n_boundary] 1 for the faces of `mirrors` that lie in a plane that cuts the solid, at whatever
  /// angle to others; all 0 where a curved patch cuts it.
  std::vector<char> faces{};
};

/// Collective. The planes in which faces of `mirrors` lie that the solid sticks out of; a solid
/// that only touches is not cut. A patch may hold several planes, and several patches may lie in
/// one. A patch is curved where a face beside those in a plane turns by less than 30 degrees; more
/// is an edge. distance: of x to the surface of the solid, negative within.
CuttingPlanes cutting_planes(const std::function<Real(const Vec3&)>& distance, const Mesh& mesh,
                             const std::vector<Patch>& mirrors);

}  // namespace fsi::vof
