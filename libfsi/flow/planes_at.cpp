#include "libfsi/flow/planes_at.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"

namespace fsi::flow {
namespace {

constexpr Real none = std::numeric_limits<Real>::max();
constexpr Real rounding = 1e-6;

/// Faces of the mirrors with a corner at the opening, as planes.
std::vector<geometry::Mirror> faces_at(const Patch& opening, const std::vector<Patch>& mirrors,
                                       const Mesh& mesh) {
  std::vector<char> at_opening(mesh.points.size(), 0);
  for (Index f = opening.begin; f < opening.end; ++f)
    for (const Index p : mesh.face_points[f]) at_opening[p] = 1;
  const auto meets = [&](Index p) { return at_opening[p] != 0; };
  std::vector<geometry::Mirror> found;
  for (const Patch& patch : mirrors)
    for (Index f = patch.begin; f < patch.end; ++f)
      if (std::ranges::any_of(mesh.face_points[f], meets))
        found.push_back({mesh.Cf[f], mesh.Sf[f] / norm(mesh.Sf[f])});
  return found;
}

/// Collective. One of the planes, the same on all ranks; its normal is zero where there is none.
geometry::Mirror first_of(const std::vector<geometry::Mirror>& planes) {
  const auto order = [](const Vec3& n) { return n.x + n.y / 3 + n.z / 7; };
  Real largest = -none;
  for (const geometry::Mirror& plane : planes) largest = std::max(largest, order(plane.n));
  largest = global_max(largest);
  if (largest == -none) return {};
  geometry::Mirror one{{-none, -none, -none}, {-none, -none, -none}};
  for (const geometry::Mirror& plane : planes)
    for (int i = 0; i < 3 && order(plane.n) >= largest - rounding; ++i)
      one.n[i] = std::max(one.n[i], plane.n[i]), one.x[i] = std::max(one.x[i], plane.x[i]);
  for (int i = 0; i < 3; ++i) one.n[i] = global_max(one.n[i]), one.x[i] = global_max(one.x[i]);
  return one;
}

}  // namespace

std::vector<geometry::Mirror> planes_at(const Patch& opening, const std::vector<Patch>& mirrors,
                                        const Mesh& mesh) {
  if (mirrors.empty()) return {};
  const PatchArea area = area_of(opening, mesh);
  std::vector<geometry::Mirror> found = faces_at(opening, mirrors, mesh), planes;
  while (true) {
    const geometry::Mirror one = first_of(found);
    if (one.n == Vec3{}) return planes;
    bool fits = planes.size() < 2 && std::abs(dot(one.n, area.vector)) < rounding * area.size;
    for (const geometry::Mirror& other : planes)
      fits = fits && std::abs(dot(one.n, other.n)) < rounding;
    if (!fits) return {};
    planes.push_back(one);
    std::erase_if(found, [&](const auto& plane) { return dot(plane.n, one.n) > 1 - rounding; });
  }
}

Real whole_diameter(const Patch& opening, const std::vector<Patch>& mirrors, const Mesh& mesh) {
  const auto planes = static_cast<int>(planes_at(opening, mirrors, mesh).size());
  const Real A = std::ldexp(area_of(opening, mesh).size, planes);
  return mesh.dim == 2 ? A : std::sqrt(4 * A / std::numbers::pi);
}

}  // namespace fsi::flow
