#include "libfsi/mesh/plex_partition.hpp"

#include <metis.h>
#include <petsc/private/partitionerimpl.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

static_assert(sizeof(idx_t) == sizeof(PetscInt));

/// Parts of the n graph vertices; balanced first, then with few edges cut by weight (none: all
/// alike). Empty on failure.
std::vector<idx_t> divide(PetscInt n_parts, PetscInt n, PetscInt start[], PetscInt adjacency[],
                          PetscInt* weight) {
  std::vector<idx_t> parts(static_cast<std::size_t>(n), 0);
  if (n_parts == 1) return parts;
  if (n <= n_parts) {  // METIS divides no graph into single vertices
    std::iota(parts.begin(), parts.end(), 0);
    return parts;
  }
  idx_t options[METIS_NOPTIONS], constraints = 1, cut = 0;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // the same parts every time
  const bool few = n_parts <= 8;   // recursive bisection is the better one for few parts
  const auto method = few ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int code = method(&n, &constraints, start, adjacency, nullptr, nullptr, weight, &n_parts,
                          nullptr, nullptr, options, &cut, parts.data());
  if (code != METIS_OK) parts.clear();
  return parts;
}

PetscErrorCode partition(PetscPartitioner part, PetscInt n_parts, PetscInt n, PetscInt start[],
                         PetscInt adjacency[], PetscSection, PetscSection, PetscSection sizes,
                         IS* points) noexcept {
  PetscFunctionBegin;
  PetscMPIInt holders = n > 0 ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &holders, 1, MPI_INT, MPI_SUM, PetscObjectComm((PetscObject)part));
  PetscCheck(holders <= 1, PETSC_COMM_SELF, PETSC_ERR_SUP, "the graph must lie on one rank");
  auto& weights = *static_cast<std::vector<PetscInt>*>(part->data);
  const std::vector<idx_t> parts =
      divide(n_parts, n, start, adjacency, weights.empty() ? nullptr : weights.data());
  PetscCheck(parts.size() == static_cast<std::size_t>(n), PETSC_COMM_SELF, PETSC_ERR_LIB,
             "METIS failed");
  for (const idx_t p : parts) PetscCall(PetscSectionAddDof(sizes, p, 1));
  PetscCall(PetscSectionSetUp(sizes));
  std::vector<PetscInt> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](PetscInt a, PetscInt b) { return parts[a] < parts[b]; });
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, n, order.data(), PETSC_COPY_VALUES, points));
  PetscFunctionReturn(0);
}

/// The constructor PETSc calls for "metis".
PetscErrorCode create_metis(PetscPartitioner part) noexcept {
  part->noGraph = PETSC_FALSE;
  part->ops->partition = partition;
  return 0;
}

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

/// 1 where the way from the cell to the face is normal to the unit vector, `slender` along it.
PetscInt weight_of(const CellList& whole, Index half, const Vec3& axis) {
  const Vec3 way = middle(whole, Half(half)) - middle(whole, Half(half).cell);
  const Real cosine = dot(way, axis) / norm(way);
  return 1 + std::lround((slender - 1) * cosine * cosine);
}

/// Cells that share a face, in the form of a CSR matrix; weights of the faces where `along` is not
/// zero, the sum of what both cells see.
struct Graph {
  std::vector<PetscInt> start{0}, adjacency, weights;
};
Graph graph_of(const CellList& whole, const Vec3& along) {
  const std::vector<Index> mate = match_faces(whole);
  const bool weighted = norm(along) > 0;
  const Vec3 axis = weighted ? along / norm(along) : Vec3{};
  Graph graph;
  for (Index c = 0; c < whole.n_cells(); ++c) {
    for (int f = 0; f < max_faces; ++f) {
      const Index half = half_of(c, f), other = mate[half];
      if (other < 0) continue;
      graph.adjacency.push_back(Half(other).cell);
      if (weighted)
        graph.weights.push_back(weight_of(whole, half, axis) + weight_of(whole, other, axis));
    }
    graph.start.push_back(static_cast<PetscInt>(graph.adjacency.size()));
  }
  return graph;
}

}  // namespace

Parts partition_cells(const CellList& whole, const std::string& partitioner, const Vec3& along) {
  Graph graph;
  if (rank() == 0) graph = graph_of(whole, along);
  PetscPartitioner part = nullptr;
  PetscSection sizes = nullptr;
  IS cells = nullptr;
  FSI_PETSC(PetscPartitionerRegister("metis", create_metis));
  FSI_PETSC(PetscPartitionerCreate(comm(), &part));
  FSI_PETSC(PetscPartitionerSetType(part, partitioner.c_str()));
  if (partitioner == "metis") part->data = &graph.weights;
  FSI_PETSC(PetscSectionCreate(comm(), &sizes));
  FSI_PETSC(PetscPartitionerPartition(part, ranks(), static_cast<PetscInt>(graph.start.size()) - 1,
                                      graph.start.data(), graph.adjacency.data(), nullptr, nullptr,
                                      sizes, &cells));
  Parts parts;
  if (rank() == 0) {
    parts.sizes.resize(static_cast<std::size_t>(ranks()));
    for (int r = 0; r < ranks(); ++r) FSI_PETSC(PetscSectionGetDof(sizes, r, &parts.sizes[r]));
    const PetscInt* list = nullptr;
    FSI_PETSC(ISGetIndices(cells, &list));
    parts.cells.assign(list, list + whole.n_cells());
    FSI_PETSC(ISRestoreIndices(cells, &list));
  }
  FSI_PETSC(ISDestroy(&cells));
  FSI_PETSC(PetscSectionDestroy(&sizes));
  FSI_PETSC(PetscPartitionerDestroy(&part));
  return parts;
}

}  // namespace fsi
