#include "libfsi/flow/planes_at.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"

namespace fsi::flow {
namespace {

constexpr Real rounding = 1e-6;

/// Faces of the mirrors with a corner at the opening, as planes.
std::vector<geometry::Mirror> faces_at(const Patch& opening, const std::vector<Patch>& mirrors,
                                       const Mesh& mesh) {
  // A face of the mirror may be on another rank than the faces of the opening that it meets.
  std::vector<Real> mine;
  for (Index f = opening.begin; f < opening.end; ++f)
    for (const Index p : mesh.face_points[f]) mine.push_back(static_cast<Real>(mesh.point_id[p]));
  std::vector<Real> at_opening = gathered(mine);
  std::ranges::sort(at_opening);
  const auto meets = [&](Index p) {
    return std::ranges::binary_search(at_opening, static_cast<Real>(mesh.point_id[p]));
  };
  std::vector<geometry::Mirror> found;
  for (const Patch& patch : mirrors)
    for (Index f = patch.begin; f < patch.end; ++f)
      if (std::ranges::any_of(mesh.face_points[f], meets))
        found.push_back({mesh.Cf[f], mesh.normal(f)});
  return found;
}

/// Collective. One of the planes, the same on all ranks; its normal is zero where there is none.
geometry::Mirror first_of(const std::vector<geometry::Mirror>& planes) {
  const auto order = [](const Vec3& n) { return n.x + n.y / 3 + n.z / 7; };
  const geometry::Mirror* first = nullptr;
  for (const geometry::Mirror& plane : planes)
    if (first == nullptr || order(plane.n) > order(first->n)) first = &plane;
  std::vector<Real> mine;
  if (first != nullptr)
    mine = {first->x.x, first->x.y, first->x.z, first->n.x, first->n.y, first->n.z};
  const std::vector<Real> all = gathered(mine);
  geometry::Mirror one{};
  for (auto v = all.begin(); v != all.end(); v += 6)
    if (const Vec3 n{v[3], v[4], v[5]}; one.n == Vec3{} || order(n) > order(one.n) + rounding)
      one = {{v[0], v[1], v[2]}, n};
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
