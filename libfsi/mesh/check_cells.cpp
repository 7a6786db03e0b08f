#include "libfsi/mesh/check_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/mesh/messages.hpp"
#include "libfsi/mesh/metrics.hpp"

namespace fsi {
namespace {

/// A cell this much smaller than the cube of its longest edge (square in 2-D) has no volume.
constexpr Real flat = 1e-14;
/// A triangle or tetrahedron this much smaller has one, and no flow in it can be believed.
constexpr Real nearly_flat = 1e-7;
/// Corners this close, as a fraction of the cell's longest distance, are one.
constexpr Real collapsed = 1e-10;
/// A corner this much below zero, as a fraction of the product of its edges, folds over.
constexpr Real folded = -1e-10;

std::string element(const RawMesh& raw, Index c) {
  return raw.file + ": element " + std::to_string(raw.tags[c]);
}

/// The corners of a cell side by side.
struct Corners {
  std::array<Vec3, max_corners> x;
  std::size_t n = 0;

  Corners(const RawMesh& raw, Index c) {
    for (const Index p : raw.corners[c]) x[n++] = raw.points[p];
  }
  std::span<const Vec3> all() const { return {x.data(), n}; }
  Vec3 mean() const {
    Vec3 sum;
    for (const Vec3& corner : all()) sum += corner;
    return sum / static_cast<Real>(n);
  }
};

/// The equations square lengths, and a cell's volume is the product of three.
void check_scale(const RawMesh& raw) {
  constexpr Real smallest = 1e-20, largest = 1e20;
  Real reach = 0;
  for (const Index p : raw.corners.index)
    for (int k = 0; k < 3; ++k)
      reach = std::max(reach, std::abs(raw.points[p][k] - raw.points[raw.corners.index[0]][k]));
  require(reach >= smallest && reach <= largest,
          raw.file + print(" is %.3g wide, out of the range from %g to %g that can be computed "
                           "with: choose another unit of length (Mesh.ScalingFactor of gmsh)",
                           reach, smallest, largest));
}

void check_points(const RawMesh& raw) {
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    const Vec3& x = raw.points[i];
    if (std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z)) continue;
    refuse(raw.file + ": node " + std::to_string(raw.point_tags[i]) + " lies at " + text_of(x));
  }
}

void flatten(RawMesh& raw) {
  Vec3 low = raw.points[raw.corners.index[0]], high = low;
  for (const Index p : raw.corners.index) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], raw.points[p][k]), high[k] = std::max(high[k], raw.points[p][k]);
    }
  }
  require(high.z - low.z <= 1e-10 * norm(high - low),
          raw.file +
              " holds no volume elements, and its surface elements do not lie in one plane "
              "z = const: z goes from " +
              print("%.6g to %.6g", low.z, high.z) +
              "; a volume of gmsh is meshed with -3 and needs a Physical Volume");
  for (Vec3& x : raw.points) x.z = 0;
}

void check_repeated(const RawMesh& raw) {
  for (Index c = 0; c < raw.n_cells(); ++c) {
    const auto corners = raw.corners[c];
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const auto before = corners.first(i);
      if (std::ranges::find(before, corners[i]) == before.end()) continue;
      refuse(element(raw, c) + " names node " + std::to_string(raw.point_tags[corners[i]]) +
             " twice");
    }
  }
}

void check_collapsed(const RawMesh& raw) {
  for (Index c = 0; c < raw.n_cells(); ++c) {
    const Corners corners(raw, c);
    Real longest = 0, shortest = std::numeric_limits<Real>::max();
    std::size_t a = 0, b = 0;
    for (std::size_t i = 0; i < corners.n; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const Real between = norm2(corners.x[i] - corners.x[k]);
        longest = std::max(longest, between);
        if (between < shortest) shortest = between, a = k, b = i;
      }
    }
    if (shortest > collapsed * collapsed * longest) continue;
    const auto node = [&](std::size_t i) {
      return std::to_string(raw.point_tags[raw.corners[c][i]]);
    };
    refuse(element(raw, c) + " has a collapsed edge: its nodes " + node(a) + " and " + node(b) +
           " lie at the same place " + text_of(corners.x[a]));
  }
}

/// Reverses the orientation of a cell by the order of its corners.
void turn(CellType type, std::span<Index> x) {
  switch (type) {
    case CellType::triangle:
      return std::swap(x[1], x[2]);
    case CellType::quad:
      return std::swap(x[1], x[3]);
    case CellType::tet:
      return std::swap(x[1], x[2]);
    case CellType::pyramid:
      return std::swap(x[1], x[3]);
    case CellType::hex:
      std::ranges::swap_ranges(x.first(4), x.last(4));
      return;
    case CellType::prism:
      std::ranges::swap_ranges(x.first(3), x.last(3));
      return;
  }
}

void check_volumes(RawMesh& raw) {
  struct Count {
    Index cells = 0, inverted = 0, first = 0;
  };
  std::map<std::int32_t, Count> entities;
  const auto inverted = [&](Index c) {
    const Corners corners(raw, c);
    Real longest = 0;
    for (const Vec3& x : corners.all()) longest = std::max(longest, norm(x - corners.x[0]));
    const Real V = cell_metrics(raw.types[c], corners.all()).V;
    const Real size = std::abs(V) / std::pow(longest, raw.dim);
    if (!(size > flat))
      refuse(element(raw, c) + " at " + text_of(corners.mean()) + " has no volume");
    const bool simplex = static_cast<int>(corners.all().size()) == raw.dim + 1;
    if (simplex && size < nearly_flat)
      refuse(
          element(raw, c) + " at " + text_of(corners.mean()) +
          print(" is flat: %.2g of its longest edge to the power of %d is its volume, and %g the "
                "least; let gmsh optimise the mesh (Mesh.Optimize = 1), or another algorithm "
                "make it (Mesh.Algorithm3D = 1)",
                size, raw.dim, nearly_flat));
    return V < 0;
  };
  for (Index c = 0; c < raw.n_cells(); ++c) {
    Count& count = entities[raw.entities[c]];
    ++count.cells;
    if (inverted(c) && count.inverted++ == 0) count.first = c;
  }
  for (const auto& [entity, count] : entities) {
    if (count.inverted == 0 || count.inverted == count.cells) continue;
    refuse(element(raw, count.first) + " at " + text_of(Corners(raw, count.first).mean()) +
           " is turned inside out, as " + std::to_string(count.inverted) + " of the " +
           std::to_string(count.cells) + " cells of its entity are");
  }
  for (Index c = 0; c < raw.n_cells(); ++c) {
    if (entities[raw.entities[c]].inverted == 0) continue;
    const auto begin = raw.corners.index.begin() + raw.corners.offset[c];
    turn(raw.types[c], {begin, begin + shape_of(raw.types[c]).corners});
  }
}

/// For each corner the ends of its edges, right-handed: their triple product is positive in a sound
/// cell. Cells with only plane sides and straight edges are left out: their volume is a sufficient
/// check.
struct Edges {
  CellType type;
  int corner;
  std::array<int, 3> end;
};
constexpr Edges edges_of_corners[] = {
    {CellType::hex, 0, {1, 3, 4}},     {CellType::hex, 1, {2, 0, 5}},
    {CellType::hex, 2, {3, 1, 6}},     {CellType::hex, 3, {0, 2, 7}},
    {CellType::hex, 4, {7, 5, 0}},     {CellType::hex, 5, {4, 6, 1}},
    {CellType::hex, 6, {5, 7, 2}},     {CellType::hex, 7, {6, 4, 3}},
    {CellType::prism, 0, {1, 2, 3}},   {CellType::prism, 1, {2, 0, 4}},
    {CellType::prism, 2, {0, 1, 5}},   {CellType::prism, 3, {5, 4, 0}},
    {CellType::prism, 4, {3, 5, 1}},   {CellType::prism, 5, {4, 3, 2}},
    {CellType::pyramid, 0, {1, 3, 4}}, {CellType::pyramid, 1, {2, 0, 4}},
    {CellType::pyramid, 2, {3, 1, 4}}, {CellType::pyramid, 3, {0, 2, 4}},
    {CellType::quad, 0, {1, 3, -1}},   {CellType::quad, 1, {2, 0, -1}},
    {CellType::quad, 2, {3, 1, -1}},   {CellType::quad, 3, {0, 2, -1}},
};

void check_tangled(const RawMesh& raw) {
  for (Index c = 0; c < raw.n_cells(); ++c) {
    const Corners corners(raw, c);
    for (const Edges& edges : edges_of_corners) {
      if (edges.type != raw.types[c]) continue;
      const Vec3 x = corners.x[edges.corner];
      const Vec3 a = corners.x[edges.end[0]] - x, b = corners.x[edges.end[1]] - x;
      const Vec3 third = edges.end[2] < 0 ? Vec3{0, 0, 1} : corners.x[edges.end[2]] - x;
      if (dot(cross(a, b), third) >= folded * norm(a) * norm(b) * norm(third)) continue;
      refuse(element(raw, c) + " is tangled: it folds over at its corner " + text_of(x));
    }
  }
}

void check_duplicates(const RawMesh& raw) {
  const auto key = [&](Index c) {
    std::array<Index, max_corners> nodes;
    nodes.fill(-1);
    std::ranges::copy(raw.corners[c], nodes.begin());
    std::ranges::sort(nodes);
    return nodes;
  };
  // A sum over its nodes differs for most cells.
  std::vector<std::pair<std::uint64_t, Index>> sorted(raw.types.size());
  for (Index c = 0; c < raw.n_cells(); ++c) {
    std::uint64_t sum = 0;
    for (const Index p : raw.corners[c]) {
      const auto n = static_cast<std::uint64_t>(p) + 1;
      sum += n * n * n * 0x9E3779B97F4A7C15u + n * n;
    }
    sorted[c] = {sum, c};
  }
  std::ranges::sort(sorted);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t k = i + 1; k < sorted.size() && sorted[k].first == sorted[i].first; ++k) {
      const Index a = sorted[i].second, b = sorted[k].second;
      if (key(a) != key(b)) continue;
      refuse(element(raw, a) + " is there twice: element " + std::to_string(raw.tags[b]) +
             " has the same nodes");
    }
  }
}

}  // namespace

void check_cells(RawMesh& raw) {
  require(!raw.points.empty(), raw.file + " holds no nodes");
  require(!raw.types.empty(),
          raw.file +
              " holds no cells: neither triangles or quads, nor tets, hexes, prisms or pyramids; "
              "where a geometry has Physical groups, gmsh saves these alone: put the cells in a "
              "Physical Surface (2-D) or Volume (3-D)");
  check_points(raw);
  if (raw.dim == 2) flatten(raw);
  check_repeated(raw);
  check_scale(raw);
  check_collapsed(raw);
  check_volumes(raw);
  check_tangled(raw);
  check_duplicates(raw);
}

}  // namespace fsi
