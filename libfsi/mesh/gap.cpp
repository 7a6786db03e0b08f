#include "libfsi/mesh/gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

constexpr Real cells_max = 1000;
constexpr int crossings_max = 20'000;  // a line that turns in a circle about an edge ends there
constexpr Real none = std::numeric_limits<Real>::infinity();

/// A line on its way. Copied between ranks as bytes.
struct Ray {
  Vec3 x, along, begin;
  Real cells = 0, width = 0;
  GlobalIndex start, cell;     // the cell it started from, and the one it enters next
  std::int32_t from, to = -1;  // patches
  std::int32_t crossings = 0, mirrored = 0;
  Vec3 turn{};  // where it was mirrored first
};

bool earlier(const Ray& a, const Ray& b) {
  return std::tuple(a.cells, a.start, a.from, a.begin.x, a.begin.y, a.begin.z) <
         std::tuple(b.cells, b.start, b.from, b.begin.x, b.begin.y, b.begin.z);
}

/// What a patch does to a line that meets it.
enum class Side : char { end, wall, mirror };

std::vector<Side> sides_of(const Mesh& mesh, const std::vector<std::string>& walls,
                           const std::vector<std::string>& mirrors) {
  std::vector<Side> sides(mesh.patches.size(), walls.empty() ? Side::wall : Side::end);
  const auto set = [&](const std::vector<std::string>& names, Side side) {
    for (const std::string& name : names)
      sides[static_cast<std::size_t>(&mesh.patch(name) - mesh.patches.data())] = side;
  };
  set(mirrors, Side::mirror), set(walls, Side::wall);
  return sides;
}

std::vector<Ray> rays_from(const Mesh& mesh, const std::vector<Side>& sides) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] != Side::wall) continue;
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Vec3 inward = -mesh.normal(f);
      const GlobalIndex id = mesh.global_id[mesh.owner[f]];
      rays.push_back({.x = mesh.Cf[f],
                      .along = inward,
                      .begin = mesh.Cf[f],
                      .start = id,
                      .cell = id,
                      .from = static_cast<std::int32_t>(i)});
    }
  }
  return rays;
}

Real extent(const Mesh& mesh, Index c, const Vec3& along) {
  Real low = none, high = -none;
  for (const Index p : mesh.cell_points[c]) {
    const Real at = dot(mesh.points[static_cast<std::size_t>(p)], along);
    low = std::min(low, at), high = std::max(high, at);
  }
  return high - low;
}

/// The length that counts as one cell for a line along that direction.
Real size(const Mesh& mesh, Index c, const Vec3& along) {
  return mesh.simplex(c) ? edge(mesh, c) : extent(mesh, c, along);
}

/// Through owned cell c; returns the face it leaves by. The plane of face f lies at
/// t = (Cf - x) . S / (along . S) where along . S > 0: the nearest is where the line goes out.
Index cross_cell(const Mesh& mesh, Index c, Ray& ray) {
  Real least = none;
  Index out = -1;
  for (const Index f : mesh.cell_faces[c]) {
    const Vec3 S = mesh.owner[f] == c ? mesh.Sf[f] : -mesh.Sf[f];
    const Real slope = dot(ray.along, S);
    if (slope <= 1e-12 * norm(S)) continue;
    const Real t = dot(mesh.face_centre(f, c) - ray.x, S) / slope;
    if (t < least) least = t, out = f;
  }
  least = std::max(least, Real{0});
  if (out < 0) return out;
  ray.cells += least / size(mesh, c, ray.along);
  ray.width += least;
  ray.x += least * ray.along;
  ++ray.crossings;
  return out;
}

void mirror(Ray& ray, const Vec3& n) {
  ray.along -= 2 * dot(ray.along, n) * n;
  if (ray.mirrored++ == 0) ray.turn = ray.x;
}

/// The end of a line on this rank: it ends (-1 or a patch in `to`), or enters a halo cell.
enum class Fate { lost, arrived, leaves };

Fate follow(const Mesh& mesh, Index c, const std::vector<Side>& sides, Real best, Ray& ray) {
  while (true) {
    const Index f = cross_cell(mesh, c, ray);
    if (f < 0 || ray.cells > best || ray.crossings > crossings_max) return Fate::lost;
    if (f >= mesh.n_internal) {
      const auto patch = std::ranges::find_if(
          mesh.patches, [&](const Patch& p) { return f >= p.begin && f < p.end; });
      ray.to = static_cast<std::int32_t>(patch - mesh.patches.begin());
      const Vec3 n = mesh.normal(f);
      const Side side = sides[static_cast<std::size_t>(ray.to)];
      if (side != Side::mirror)
        return side == Side::wall && dot(ray.along, n) > std::sqrt(0.5) ? Fate::arrived
                                                                        : Fate::lost;
      mirror(ray, n);
      continue;
    }
    const Vec3 period = mesh.translation[static_cast<std::size_t>(mesh.shift[f])];
    if (mesh.owner[f] == c)
      c = mesh.neighbour[f], ray.x -= period;
    else
      c = mesh.owner[f], ray.x += period;
    if (c < mesh.n_owned) continue;
    ray.cell = mesh.global_id[c];
    return Fate::leaves;
  }
}

/// Collective. All ranks' items, in the order of the ranks.
std::vector<Ray> share(const std::vector<Ray>& mine) {
  int bytes = static_cast<int>(mine.size() * sizeof(Ray));
  std::vector<int> counts(static_cast<std::size_t>(ranks())), begin(counts.size());
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm());
  int total = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) begin[r] = total, total += counts[r];
  std::vector<Ray> all(static_cast<std::size_t>(total) / sizeof(Ray));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), begin.data(), MPI_BYTE,
                 comm());
  return all;
}

/// The owned cell of that number, or -1.
Index owned_cell(const Mesh& mesh, GlobalIndex id) {
  const auto end = mesh.global_id.begin() + mesh.n_owned;
  const auto found = std::lower_bound(mesh.global_id.begin(), end, id);
  return found != end && *found == id ? static_cast<Index>(found - mesh.global_id.begin()) : -1;
}

}  // namespace

Real edge(const Mesh& mesh, Index c) {
  const Real V = mesh.V[c];
  switch (mesh.type(c)) {
    case CellType::triangle:
      return std::sqrt(4 / std::sqrt(3.0) * V);
    case CellType::tet:
      return std::cbrt(6 * std::sqrt(2.0) * V);
    case CellType::prism:
      return std::cbrt(4 / std::sqrt(3.0) * V);
    case CellType::pyramid:
      return std::cbrt(3 * std::sqrt(2.0) * V);
    case CellType::quad:
      return std::sqrt(V);
    case CellType::hex:
      break;
  }
  return std::cbrt(V);
}

Gap narrowest_gap(const Mesh& mesh, const std::vector<std::string>& walls,
                  const std::vector<std::string>& mirrors) {
  const std::vector<Side> sides = sides_of(mesh, walls, mirrors);
  std::vector<Ray> rays = rays_from(mesh, sides), arrived;
  Real best = cells_max;
  while (true) {
    std::vector<Ray> leaving;
    for (Ray& ray : rays) {
      const Index c = owned_cell(mesh, ray.cell);
      if (c < 0) continue;
      const Fate fate = follow(mesh, c, sides, best, ray);
      if (fate == Fate::leaves) leaving.push_back(ray);
      if (fate != Fate::arrived) continue;
      best = std::min(best, ray.cells);
      arrived.push_back(ray);
    }
    best = global_min(best);
    rays = share(leaving);
    if (rays.empty()) break;
  }
  const auto shortest = std::ranges::min_element(arrived, earlier);
  std::vector<Ray> offered;
  if (shortest != arrived.end()) offered.push_back(*shortest);
  offered = share(offered);
  const auto found = std::ranges::min_element(offered, earlier);
  if (found == offered.end()) return {};
  const auto name = [&](std::int32_t i) { return mesh.patches[static_cast<std::size_t>(i)].name; };
  const Vec3 middle =
      found->mirrored > 0 ? found->turn : found->begin + 0.5 * found->width * found->along;
  return {found->cells, found->width, middle, name(found->from), name(found->to)};
}

}  // namespace fsi
