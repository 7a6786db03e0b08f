#include "libfsi/vof/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "libfsi/core/parallel.hpp"

namespace fsi::vof {
namespace {

using geometry::Mirror;

/// Of the angle between two planes: below it they are parallel, or at right angles.
constexpr Real level = 1e-6;

/// The planes found so far, and what two points of one may be apart.
struct Planes {
  Real touching;
  std::size_t most;  // one more than can be at right angles: that is odd already
  std::vector<Mirror> all{};

  void add(const Mirror& plane) {
    const auto same = [&](const Mirror& other) { return other.is_same(plane, level, touching); };
    if (all.size() < most && std::ranges::none_of(all, same)) all.push_back(plane);
  }
};

Mirror plane_of(Index f, const Mesh& mesh) { return {mesh.Cf[f], mesh.Sf[f] / norm(mesh.Sf[f])}; }

bool sticks_out(const std::function<Real(const Vec3&)>& distance, const Mesh& mesh, Index f,
                Real touching) {
  if (distance(mesh.Cf[f]) < -touching) return true;
  return std::ranges::any_of(mesh.face_points[f],
                             [&](Index p) { return distance(mesh.points[p]) < -touching; });
}

/// Adds those of the other ranks, in the order of the ranks.
void share(Planes& planes) {
  std::vector<Real> mine;
  for (const Mirror& m : planes.all)
    mine.insert(mine.end(), {m.x.x, m.x.y, m.x.z, m.n.x, m.n.y, m.n.z});
  const std::vector<Real> of_all = gathered(mine);
  planes.all.clear();
  for (auto v = of_all.begin(); v != of_all.end(); v += 6)
    planes.add({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
}

bool at_right_angles(const std::vector<Mirror>& planes) {
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(dot(planes[i].n, planes[j].n)) >= level) return false;
  return true;
}

}  // namespace

CuttingPlanes cutting_planes(const std::function<Real(const Vec3&)>& distance, const Mesh& mesh,
                             const std::vector<Patch>& mirrors) {
  const Real touching = 1e-6 * std::pow(mesh.total_volume, 1.0 / mesh.dim);
  Planes planes{.touching = touching, .most = static_cast<std::size_t>(mesh.dim) + 1};
  for (const Patch& patch : mirrors)
    for (Index f = patch.begin; f < patch.end; ++f)
      if (sticks_out(distance, mesh, f, touching)) planes.add(plane_of(f, mesh));
  share(planes);
  std::vector<char> faces(static_cast<std::size_t>(mesh.n_boundary()), 0);
  if (!at_right_angles(planes.all)) return {.odd = true, .faces = faces};
  for (const Patch& patch : mirrors)
    for (Index f = patch.begin; f < patch.end; ++f) {
      const auto holds = [&](const Mirror& plane) {
        return plane.is_same(plane_of(f, mesh), level, touching);
      };
      faces[static_cast<std::size_t>(f - mesh.n_internal)] =
          std::ranges::any_of(planes.all, holds) ? 1 : 0;
    }
  return {.planes = planes.all, .faces = faces};
}

}  // namespace fsi::vof
