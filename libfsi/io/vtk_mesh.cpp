#include "libfsi/io/vtk_mesh.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <tuple>

#include "libfsi/core/error.hpp"
#include "libfsi/io/collect.hpp"

namespace fsi::io {
namespace {

/// VTK's number of a cell type [VTK] vtkCellType.h, by dimension and count of corners.
std::uint8_t type_of(int dim, std::size_t corners) {
  if (dim == 2) return corners == 3 ? 5 : 9;  // triangle, quad
  switch (corners) {
    case 4:
      return 10;  // tetra
    case 8:
      return 12;  // hexahedron
    case 6:
      return 13;  // wedge
    case 5:
      return 14;  // pyramid
    default:
      throw Error(Kind::internal, "a cell of " + std::to_string(corners) + " corners");
  }
}

/// What a rank tells of its owned cells.
struct Part {
  std::vector<GlobalIndex> id;  // [cells]
  std::vector<Index> first;     // [cells + 1] where a cell's corners begin
  std::vector<Index> corners;   // into points
  std::vector<Vec3> points;
};

Part part_of(const Mesh& mesh, std::span<const Index> cells) {
  Part part;
  part.first.push_back(0);
  for (const Index c : cells) {
    part.id.push_back(mesh.global_id[c]);
    const auto corners = mesh.cell_points[c];
    part.corners.insert(part.corners.end(), corners.begin(), corners.end());
    part.first.push_back(static_cast<Index>(part.corners.size()));
  }
  std::vector<Index> number(mesh.points.size(), -1);
  for (Index& p : part.corners) {
    Index& n = number[static_cast<std::size_t>(p)];
    if (n < 0) {
      n = static_cast<Index>(part.points.size());
      part.points.push_back(mesh.points[static_cast<std::size_t>(p)]);
    }
    p = n;
  }
  return part;
}

/// For each point the lowest number of a point at the same place.
std::vector<std::int64_t> same_place(const std::vector<Vec3>& points) {
  const auto place = [&](std::int64_t i) {
    const Vec3& x = points[static_cast<std::size_t>(i)];
    return std::tuple(x.x, x.y, x.z);
  };
  std::vector<std::int64_t> order(points.size()), lowest(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
    return std::tuple(place(a), a) < std::tuple(place(b), b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && place(order[i]) == place(order[i - 1]);
    lowest[static_cast<std::size_t>(order[i])] =
        again ? lowest[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return lowest;
}

/// The parts as one, cells still in the order of the ranks.
Part joined(std::vector<Part> parts) {
  Part all = std::move(parts.front());
  for (std::size_t r = 1; r < parts.size(); ++r) {
    const Part& part = parts[r];
    const auto base = static_cast<Index>(all.points.size()), start = all.first.back();
    all.id.insert(all.id.end(), part.id.begin(), part.id.end());
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
    for (std::size_t c = 1; c < part.first.size(); ++c) all.first.push_back(start + part.first[c]);
    for (const Index p : part.corners) all.corners.push_back(base + p);
  }
  return all;
}

/// The cells by their number in the mesh file, points numbered as they come.
VtkMesh in_file_order(const Part& all, int dim) {
  const std::vector<std::int64_t> lowest = same_place(all.points);
  std::vector<std::size_t> cell(all.id.size());
  std::iota(cell.begin(), cell.end(), 0);
  std::ranges::sort(cell, {}, [&](std::size_t i) { return all.id[i]; });
  std::vector<std::int64_t> number(all.points.size(), -1);
  VtkMesh mesh;
  mesh.connectivity.reserve(all.corners.size());
  mesh.offsets.reserve(cell.size() + 1);
  mesh.types.reserve(cell.size());
  mesh.offsets.push_back(0);
  for (const std::size_t i : cell) {
    const auto n = static_cast<std::size_t>(all.first[i + 1] - all.first[i]);
    for (std::size_t k = 0; k < n; ++k) {
      // VTK turns the two triangles of a wedge outward: 0 2 1, 3 5 4.
      constexpr std::array<std::size_t, 6> wedge{0, 2, 1, 3, 5, 4};
      const std::size_t corner = static_cast<std::size_t>(all.first[i]) + (n == 6 ? wedge[k] : k);
      const auto point = static_cast<std::size_t>(all.corners[corner]);
      std::int64_t& p = number[static_cast<std::size_t>(lowest[point])];
      if (p < 0) {
        p = static_cast<std::int64_t>(mesh.points.size() / 3);
        for (int a = 0; a < 3; ++a) mesh.points.push_back(all.points[point][a]);
      }
      mesh.connectivity.push_back(p);
    }
    mesh.offsets.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
    mesh.types.push_back(type_of(dim, n));
  }
  return mesh;
}

}  // namespace

VtkMesh vtk_mesh(const Mesh& mesh) {
  std::vector<Index> all(static_cast<std::size_t>(mesh.n_owned));
  std::iota(all.begin(), all.end(), 0);
  return vtk_mesh(mesh, all);
}

VtkMesh vtk_mesh(const Mesh& mesh, std::span<const Index> cells) {
  std::vector<Part> parts;
  {
    const Part mine = part_of(mesh, cells);
    auto ids = collect(mine.id);
    auto firsts = collect(mine.first), corners = collect(mine.corners);
    auto points = collect(mine.points);
    for (std::size_t r = 0; r < ids.size(); ++r)
      parts.push_back(
          {std::move(ids[r]), std::move(firsts[r]), std::move(corners[r]), std::move(points[r])});
  }
  return parts.empty() ? VtkMesh{} : in_file_order(joined(std::move(parts)), mesh.dim);
}

}  // namespace fsi::io
