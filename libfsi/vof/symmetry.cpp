#include "libfsi/vof/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "libfsi/core/parallel.hpp"

namespace fsi::vof {
namespace {

using geometry::Mirror;

/// Angle below which planes are parallel or at right angles, and part of a face's size that its
/// centre may lie off its plane: what the digits of a mesh file leave.
constexpr Real level = 1e-3;
/// More planes than this are the facets of a curved patch.
constexpr std::size_t most = 8;

Real size_of(Index f, const Mesh& mesh) {
  const Real S = norm(mesh.Sf[f]);
  return mesh.dim == 2 ? S : std::sqrt(S);
}

bool lies_in(const Mirror& plane, const Vec3& x, const Vec3& n, Real size) {
  return norm(cross(plane.n, n)) < level && std::abs(dot(x - plane.x, plane.n)) < level * size;
}

/// A plane found by a face, and the size of that face.
struct Found {
  Mirror plane;
  Real size;
};

void add(std::vector<Found>& all, const Found& found) {
  const auto same = [&](const Found& other) {
    return lies_in(other.plane, found.plane.x, found.plane.n, found.size);
  };
  if (all.size() <= most && std::ranges::none_of(all, same)) all.push_back(found);
}

bool sticks_out(const std::function<Real(const Vec3&)>& distance, const Mesh& mesh, Index f,
                Real touching) {
  if (distance(mesh.Cf[f]) < -touching) return true;
  return std::ranges::any_of(mesh.face_points[f],
                             [&](Index p) { return distance(mesh.points[p]) < -touching; });
}

/// Those of all ranks, in the order of the ranks.
std::vector<Mirror> shared(const std::vector<Found>& mine) {
  std::vector<Real> numbers;
  for (const auto& [m, size] : mine)
    numbers.insert(numbers.end(), {m.x.x, m.x.y, m.x.z, m.n.x, m.n.y, m.n.z, size});
  const std::vector<Real> of_all = gathered(numbers);
  std::vector<Found> all;
  for (auto v = of_all.begin(); v != of_all.end(); v += 7)
    add(all, {{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}, v[6]});
  std::vector<Mirror> planes;
  for (const Found& found : all) planes.push_back(found.plane);
  return planes;
}

bool at_right_angles(const std::vector<Mirror>& planes) {
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(dot(planes[i].n, planes[j].n)) >= level) return false;
  return true;
}

/// Whether a face of `mirrors` that shares a point with one in a plane turns a little.
bool is_curved(const std::vector<char>& faces, const std::vector<Mirror>& planes, const Mesh& mesh,
               const std::vector<Patch>& mirrors) {
  constexpr Real cos_of_edge = 0.866;  // 30 degrees
  std::unordered_set<Index> points;
  for (Index b = 0; b < mesh.n_boundary(); ++b)
    if (faces[b] != 0)
      for (const Index p : mesh.face_points[mesh.n_internal + b]) points.insert(p);
  bool curved = false;
  for (const Patch& patch : mirrors)
    for (Index f = patch.begin; f < patch.end; ++f) {
      if (faces[f - mesh.n_internal] != 0) continue;
      const auto beside = [&](Index p) { return points.contains(p); };
      const Vec3 n = mesh.normal(f);
      const auto near = [&](const Mirror& plane) { return dot(plane.n, n) > cos_of_edge; };
      curved = curved || (std::ranges::any_of(mesh.face_points[f], beside) &&
                          std::ranges::any_of(planes, near));
    }
  return !all_of_ranks(!curved);
}

}  // namespace

CuttingPlanes cutting_planes(const std::function<Real(const Vec3&)>& distance, const Mesh& mesh,
                             const std::vector<Patch>& mirrors) {
  const Real touching = 1e-6 * std::pow(mesh.total_volume, 1.0 / mesh.dim);
  std::vector<Found> found;
  for (const Patch& patch : mirrors)
    for (Index f = patch.begin; f < patch.end; ++f)
      if (sticks_out(distance, mesh, f, touching))
        add(found, {{mesh.Cf[f], mesh.normal(f)}, size_of(f, mesh)});
  const std::vector<Mirror> planes = shared(found);
  const std::vector<char> none(static_cast<std::size_t>(mesh.n_boundary()), 0);
  if (planes.size() > most) return {.odd = true, .faces = none};
  std::vector<char> faces = none;
  for (const Patch& patch : mirrors)
    for (Index f = patch.begin; f < patch.end; ++f)
      faces[f - mesh.n_internal] = std::ranges::any_of(planes, [&](const Mirror& plane) {
        return lies_in(plane, mesh.Cf[f], mesh.normal(f), size_of(f, mesh));
      });
  if (is_curved(faces, planes, mesh, mirrors)) return {.odd = true, .faces = none};
  if (!at_right_angles(planes)) return {.odd = true, .faces = faces};
  return {.planes = planes, .faces = faces};
}

}  // namespace fsi::vof
