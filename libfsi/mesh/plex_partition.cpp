#include "libfsi/mesh/plex_partition.hpp"

#include <petscdmplex.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/divide.hpp"

namespace fsi {
namespace {

static_assert(sizeof(PetscInt) == sizeof(std::int32_t));

/// Mean of the corners of a cell, and of one of its faces.
Vec3 middle(const CellList& list, Index cell) {
  Vec3 sum;
  for (const Index p : list.corners[cell]) sum += list.points[p];
  return sum / static_cast<Real>(list.corners[cell].size());
}
Vec3 middle(const CellList& list, Half half) {
  const auto corners = shape_of(list.types[half.cell]).face_corners(half.face);
  Vec3 sum;
  for (const std::int8_t i : corners) sum += list.points[list.corners[half.cell][i]];
  return sum / static_cast<Real>(corners.size());
}

/// A load in whole numbers, as METIS takes it: eighths, less than a thousand.
std::int32_t load_units(Real load) {
  return static_cast<std::int32_t>(std::lround(8 * std::clamp(load, 0.0, 1000.0)));
}

/// 1 where the way from the cell to the face is normal to the unit vector, `slender` along it.
std::int32_t weight_of(const CellList& whole, Index half, const Vec3& axis) {
  const Vec3 way = middle(whole, Half(half)) - middle(whole, Half(half).cell);
  const Real cosine = dot(way, axis) / norm(way);
  return 1 + static_cast<std::int32_t>(std::lround((slender - 1) * cosine * cosine));
}

/// The graph of the cells; ties where `along` is not zero, the sum of what both cells see; load
/// where there is a function of it.
Graph graph_of(const CellList& whole, const Vec3& along, const CellLoad& load) {
  const std::vector<Index> mate = match_faces(whole);
  const bool tied = norm(along) > 0;
  const Vec3 axis = tied ? along / norm(along) : Vec3{};
  Graph graph;
  for (Index c = 0; c < whole.n_cells(); ++c) {
    for (int f = 0; f < max_faces; ++f) {
      const Index half = half_of(c, f), other = mate[half];
      if (other < 0) continue;
      graph.neighbours.push_back(Half(other).cell);
      if (tied) graph.ties.push_back(weight_of(whole, half, axis) + weight_of(whole, other, axis));
    }
    graph.start.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
    if (load) graph.load.push_back(load_units(load(middle(whole, c))));
  }
  if (std::ranges::none_of(graph.load, [](std::int32_t l) { return l > 0; })) graph.load.clear();
  return graph;
}

/// Part after part, the cells of each.
Parts sorted(const std::vector<std::int32_t>& part) {
  if (part.empty()) throw Error(Kind::internal, "METIS could not divide the mesh");
  Parts parts;
  parts.sizes.resize(static_cast<std::size_t>(ranks()));
  for (const std::int32_t p : part) ++parts.sizes[p];
  parts.cells.resize(part.size());
  std::iota(parts.cells.begin(), parts.cells.end(), 0);
  std::ranges::stable_sort(parts.cells, {}, [&](PetscInt c) { return part[c]; });
  return parts;
}

/// By a partitioner of PETSc's own.
Parts partition_by_petsc(Graph graph, const std::string& partitioner) {
  PetscPartitioner part = nullptr;
  PetscSection sizes = nullptr;
  IS cells = nullptr;
  FSI_PETSC(PetscPartitionerCreate(comm(), &part));
  FSI_PETSC(PetscPartitionerSetType(part, partitioner.c_str()));
  FSI_PETSC(PetscSectionCreate(comm(), &sizes));
  FSI_PETSC(PetscPartitionerPartition(part, ranks(), graph.cells(), graph.start.data(),
                                      graph.neighbours.data(), nullptr, nullptr, sizes, &cells));
  Parts parts;
  if (rank() == 0) {
    parts.sizes.resize(static_cast<std::size_t>(ranks()));
    for (int r = 0; r < ranks(); ++r) FSI_PETSC(PetscSectionGetDof(sizes, r, &parts.sizes[r]));
    const PetscInt* list = nullptr;
    FSI_PETSC(ISGetIndices(cells, &list));
    parts.cells.assign(list, list + graph.cells());
    FSI_PETSC(ISRestoreIndices(cells, &list));
  }
  FSI_PETSC(ISDestroy(&cells));
  FSI_PETSC(PetscSectionDestroy(&sizes));
  FSI_PETSC(PetscPartitionerDestroy(&part));
  return parts;
}

}  // namespace

Parts partition_cells(const CellList& whole, const Division& how) {
  Graph graph;
  if (rank() == 0) graph = graph_of(whole, how.along, how.load);
  if (how.partitioner != "metis") return partition_by_petsc(std::move(graph), how.partitioner);
  return rank() == 0 ? sorted(divide(graph, ranks())) : Parts{};
}

}  // namespace fsi
