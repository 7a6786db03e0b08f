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
  bool odd = false;                        ///< whether the solid is cut, but not by such planes
  std::vector<char> faces{};  ///< [n_boundary] 1 for faces of patches in `planes`, else 0
};

/// Collective. The planes in which faces of `mirrors` lie that the solid sticks out of; a solid
/// that only touches is not cut. A patch may hold several planes, and several patches may lie in
/// one. distance: of x to the surface of the solid, negative within. A curved patch is odd.
CuttingPlanes cutting_planes(const std::function<Real(const Vec3&)>& distance, const Mesh& mesh,
                             const std::vector<Patch>& mirrors);

}  // namespace fsi::vof
