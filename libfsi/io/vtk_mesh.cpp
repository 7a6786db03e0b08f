#include "libfsi/io/vtk_mesh.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/cells.hpp"
#include "libfsi/mesh/exchange.hpp"

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
      throw Error(ErrorKind::internal, "a cell of " + std::to_string(corners) + " corners");
  }
}

// VTK turns the two triangles of a wedge outward.
constexpr std::array<std::size_t, 6> wedge{0, 2, 1, 3, 5, 4};

/// A point and a cell on their way to the ranks in whose stretches they lie.
struct PlacedPoint {
  Vec3 x;
  Index id;
};
struct PlacedCell {
  GlobalIndex id;
  std::array<std::int64_t, max_corners> points;
  std::int32_t corners;
};

/// The sum of what the ranks before this one have.
std::int64_t before(std::size_t mine) {
  auto count = static_cast<std::int64_t>(mine);
  std::int64_t sum = 0;
  MPI_Exscan(&count, &sum, 1, MPI_INT64_T, MPI_SUM, comm());
  return rank() == 0 ? 0 : sum;
}

/// Numbers the points of owned cells in the order of the mesh as read; fills this rank's stretch of
/// them. Returns the number of each local point; -1 where no owned cell has it.
std::vector<std::int64_t> number_points(const Mesh& mesh, VtkMesh& vtk) {
  Index ids = 0;
  for (const Index id : mesh.point_id) ids = std::max(ids, id + 1);
  MPI_Allreduce(MPI_IN_PLACE, &ids, 1, MPI_INT32_T, MPI_MAX, comm());
  const Stretches where = Stretches::even(ids);
  std::vector<std::int64_t> number(mesh.points.size(), -1);
  for (Index i = 0; i < mesh.cell_points.offset[mesh.n_owned]; ++i)
    number[static_cast<std::size_t>(mesh.cell_points.index[i])] = 0;
  std::vector<std::vector<PlacedPoint>> to(static_cast<std::size_t>(ranks()));
  std::vector<std::vector<std::size_t>> asked(to.size());
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] < 0) continue;
    const auto holder = static_cast<std::size_t>(where.holder(mesh.point_id[p]));
    to[holder].push_back({mesh.points[p], mesh.point_id[p]}), asked[holder].push_back(p);
  }
  const Received<PlacedPoint> came = exchange(std::move(to));
  std::vector<std::int64_t> number_of(static_cast<std::size_t>(where.mine()), -1);
  std::vector<Vec3> x(number_of.size());
  const auto at = [&](const PlacedPoint& point) {
    return static_cast<std::size_t>(point.id - where.first());
  };
  for (const PlacedPoint& point : came.items) number_of[at(point)] = 0, x[at(point)] = point.x;
  std::int64_t next = before(static_cast<std::size_t>(std::ranges::count(number_of, 0)));
  for (std::size_t i = 0; i < number_of.size(); ++i) {
    if (number_of[i] < 0) continue;
    number_of[i] = next++;
    for (int k = 0; k < 3; ++k) vtk.points.push_back(x[i][k]);
  }
  std::vector<std::vector<std::int64_t>> told(static_cast<std::size_t>(ranks()));
  for (std::size_t r = 0; r < told.size(); ++r)
    for (int i = came.begin[r]; i < came.begin[r + 1]; ++i)
      told[r].push_back(number_of[at(came.items[static_cast<std::size_t>(i)])]);
  const Received<std::int64_t> answers = exchange(std::move(told));
  for (std::size_t r = 0; r < asked.size(); ++r) {
    auto answer = answers.items.begin() + answers.begin[r];
    for (const std::size_t p : asked[r]) number[p] = *answer++;
  }
  return number;
}

/// The cells of this rank's stretch, in file order.
std::vector<PlacedCell> placed_cells(const Mesh& mesh, const std::vector<std::int64_t>& number) {
  const Stretches where = Stretches::even(static_cast<Index>(mesh.n_global));
  std::vector<std::vector<PlacedCell>> to(static_cast<std::size_t>(ranks()));
  for (Index c = 0; c < mesh.n_owned; ++c) {
    PlacedCell cell{mesh.global_id[c], {}, 0};
    for (const Index p : mesh.cell_points[c])
      cell.points[static_cast<std::size_t>(cell.corners++)] = number[static_cast<std::size_t>(p)];
    to[static_cast<std::size_t>(where.holder(static_cast<Index>(cell.id)))].push_back(cell);
  }
  std::vector<PlacedCell> cells = exchange(std::move(to)).items;
  std::ranges::sort(cells, {}, &PlacedCell::id);
  return cells;
}

}  // namespace

VtkMesh vtk_mesh(const Mesh& mesh) {
  VtkMesh vtk;
  const std::vector<std::int64_t> number = number_points(mesh, vtk);
  for (const PlacedCell& cell : placed_cells(mesh, number)) {
    const auto n = static_cast<std::size_t>(cell.corners);
    vtk.offsets.push_back(static_cast<std::int64_t>(vtk.connectivity.size()));
    for (std::size_t k = 0; k < n; ++k) {
      vtk.connectivity.push_back(cell.points[n == 6 ? wedge[k] : k]);
    }
    vtk.types.push_back(type_of(mesh.dim, n));
  }
  if (rank() + 1 == ranks())
    vtk.offsets.push_back(static_cast<std::int64_t>(vtk.connectivity.size()));
  const std::int64_t first = before(vtk.connectivity.size());
  for (std::int64_t& offset : vtk.offsets) offset += first;
  return vtk;
}

VtkMesh vtk_cells(const Mesh& mesh, std::span<const Index> cells) {
  std::vector<Real> mine;  // of each cell its number, its corners and where they are
  for (const Index c : cells) {
    const auto corners = mesh.cell_points[c];
    mine.push_back(static_cast<Real>(mesh.global_id[c]));
    mine.push_back(static_cast<Real>(corners.size()));
    for (const Index p : corners)
      for (int i = 0; i < 3; ++i) mine.push_back(mesh.points[p][i]);
  }
  const std::vector<Real> all = gathered(mine);
  std::vector<std::size_t> begin;
  for (std::size_t at = 0; at < all.size(); at += 2 + 3 * static_cast<std::size_t>(all[at + 1]))
    begin.push_back(at);
  std::ranges::sort(begin, {}, [&](std::size_t at) { return all[at]; });
  VtkMesh vtk;
  for (const std::size_t at : begin) {
    const auto n = static_cast<std::size_t>(all[at + 1]);
    vtk.offsets.push_back(static_cast<std::int64_t>(vtk.connectivity.size()));
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t x = at + 2 + 3 * (n == 6 ? wedge[k] : k);
      vtk.connectivity.push_back(static_cast<std::int64_t>(vtk.connectivity.size()));
      vtk.points.insert(vtk.points.end(), all.begin() + static_cast<std::ptrdiff_t>(x),
                        all.begin() + static_cast<std::ptrdiff_t>(x) + 3);
    }
    vtk.types.push_back(type_of(mesh.dim, n));
  }
  vtk.offsets.push_back(static_cast<std::int64_t>(vtk.connectivity.size()));
  return vtk;
}

}  // namespace fsi::io
