#include "libfsi/mesh/plex_partition.hpp"

#include <petscdmplex.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/columns.hpp"
#include "libfsi/mesh/divide.hpp"

namespace fsi {
namespace {

static_assert(sizeof(PetscInt) == sizeof(std::int32_t));

/// A load in whole numbers, as METIS takes it: eighths, less than a thousand.
std::int32_t load_units(Real load) {
  return static_cast<std::int32_t>(std::lround(8 * std::clamp(load, 0.0, 1000.0)));
}

/// A face as one of its cells sends it to the rank that joins both cells.
struct Side {
  std::array<Index, max_face_corners> key;  // vertices by number in the mesh as read, ascending
  Index cell;                               // number in the mesh as read
};

/// The cell on the other side of each; -1: none.
std::vector<Index> matched(const std::vector<Side>& sides) {
  std::vector<Index> answers(sides.size(), -1);
  std::vector<std::size_t> order(sides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(
      order, {}, [&](std::size_t i) -> const auto& { return sides[i].key; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    const std::size_t i = order[k - 1], j = order[k];
    if (sides[i].key != sides[j].key) continue;
    answers[i] = sides[j].cell, answers[j] = sides[i].cell;
  }
  return answers;
}

/// A side as it is told, on its way to the rank that holds its lowest vertex.
Side side_of(const CellList& here, Index half, Index first_cell) {
  const Half h(half);
  Side side{{-1, -1, -1, -1}, first_cell + h.cell};
  std::size_t n = 0;
  for (const std::int8_t i : shape_of(here.types[h.cell]).face_corners(h.face)) {
    side.key[n++] = here.vertex_id[here.corners[h.cell][i]];
  }
  std::ranges::sort(side.key);
  return side;
}

/// Collective. For each of the halves without a mate here the cell that has it elsewhere.
std::vector<Index> sought(const CellList& here, const std::vector<Index>& halves,
                          const Stretches& cells, Index n_vertices) {
  const Stretches vertices = Stretches::even(n_vertices);
  std::vector<std::vector<Side>> to(static_cast<std::size_t>(ranks()));
  std::vector<std::vector<std::size_t>> asked(to.size());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const Side side = side_of(here, halves[i], cells.first());
    const int holder =
        vertices.holder(*std::ranges::find_if(side.key, [](Index v) { return v >= 0; }));
    to[holder].push_back(side), asked[holder].push_back(i);
  }
  const Received<Side> sides = exchange(std::move(to));
  const std::vector<Index> found = matched(sides.items);
  std::vector<std::vector<Index>> told;
  for (std::size_t r = 0; r + 1 < sides.begin.size(); ++r) {
    told.emplace_back(found.begin() + sides.begin[r], found.begin() + sides.begin[r + 1]);
  }
  const Received<Index> answers = exchange(std::move(told));
  std::vector<Index> result(halves.size());
  for (std::size_t r = 0; r < asked.size(); ++r) {
    auto answer = answers.items.begin() + answers.begin[r];
    for (const std::size_t i : asked[r]) result[i] = *answer++;
  }
  return result;
}

/// Collective. The loads of this rank's cells; empty: none.
std::vector<std::int32_t> loads_of(const CellList& here, const Stretches& cells,
                                   const Division& how) {
  std::vector<std::int32_t> units;
  if (how.loads) {
    for (const Real load : how.loads(cells.first(), here.n_cells())) {
      units.push_back(load_units(load));
    }
  } else if (how.load) {
    for (Index c = 0; c < here.n_cells(); ++c) {
      units.push_back(load_units(how.load(middle(here, c), here.dim)));
    }
  }
  return units;
}

/// Collective. The graph of this rank's cells; columns where `along` is not zero, load where there
/// is a function of it. Neighbours stand in the order of the faces: the same whoever holds the
/// cells.
Graph graph_of(const CellList& here, const Stretches& cells, Index n_vertices,
               const Division& how) {
  const std::vector<Index> mate = match_faces(here);
  std::vector<Index> open;
  for (Index c = 0; c < here.n_cells(); ++c) {
    for (int f = 0; f < shape_of(here.types[c]).faces; ++f) {
      if (mate[half_of(c, f)] < 0) open.push_back(half_of(c, f));
    }
  }
  const std::vector<Index> beyond = sought(here, open, cells, n_vertices);
  Graph graph;
  auto next = beyond.begin();
  for (Index c = 0; c < here.n_cells(); ++c) {
    for (int f = 0; f < shape_of(here.types[c]).faces; ++f) {
      const Index other = mate[half_of(c, f)];
      const Index far = other < 0 ? *next++ : cells.first() + Half(other).cell;
      if (far >= 0) graph.neighbours.push_back(far);
    }
    graph.start.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
  }
  graph.load = loads_of(here, cells, how);
  if (norm(how.along) > 0) graph.column = columns_of(here, how.along);
  return graph;
}

/// Collective. Everybody's items, rank after rank, on rank 0.
std::vector<std::int32_t> gathered(const std::vector<std::int32_t>& mine) {
  std::vector<std::vector<std::int32_t>> to(static_cast<std::size_t>(ranks()));
  to[0] = mine;
  return exchange(std::move(to)).items;
}

/// Collective. The graphs of all ranks as one, on rank 0.
Graph gathered(const Graph& mine) {
  Graph whole;
  std::vector<std::int32_t> degrees;
  for (std::int32_t c = 0; c < mine.cells(); ++c) {
    degrees.push_back(mine.start[c + 1] - mine.start[c]);
  }
  for (const std::int32_t degree : gathered(degrees)) {
    whole.start.push_back(whole.start.back() + degree);
  }
  whole.neighbours = gathered(mine.neighbours);
  whole.column = gathered(mine.column), whole.load = gathered(mine.load);
  if (std::ranges::none_of(whole.load, [](std::int32_t l) { return l > 0; })) whole.load.clear();
  return whole;
}

/// Collective. Each rank's stretch of what rank 0 holds.
std::vector<std::int32_t> scattered(const std::vector<std::int32_t>& all, const Stretches& cells) {
  std::vector<std::vector<std::int32_t>> to(static_cast<std::size_t>(ranks()));
  for (std::size_t r = 0; r < to.size() && !all.empty(); ++r) {
    to[r].assign(all.begin() + cells.begin[r], all.begin() + cells.begin[r + 1]);
  }
  return exchange(std::move(to)).items;
}

/// Part after part, the cells of each.
Parts sorted(const std::vector<std::int32_t>& part) {
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
  parts.sizes.resize(static_cast<std::size_t>(ranks()));
  for (int r = 0; r < ranks(); ++r) FSI_PETSC(PetscSectionGetDof(sizes, r, &parts.sizes[r]));
  const PetscInt* list = nullptr;
  FSI_PETSC(ISGetIndices(cells, &list));
  parts.cells.assign(list, list + graph.cells());
  FSI_PETSC(ISRestoreIndices(cells, &list));
  FSI_PETSC(ISDestroy(&cells));
  FSI_PETSC(PetscSectionDestroy(&sizes));
  FSI_PETSC(PetscPartitionerDestroy(&part));
  return parts;
}

}  // namespace

Parts partition_cells(const CellList& here, const Stretches& cells, Index n_vertices,
                      const Division& how) {
  Graph graph = graph_of(here, cells, n_vertices, how);
  if (how.partitioner != "metis") return partition_by_petsc(std::move(graph), how.partitioner);
  graph = gathered(graph);
  std::vector<std::int32_t> part;
  if (rank() == 0) part = divide(graph, ranks());
  const bool divided = static_cast<Index>(part.size()) == (rank() == 0 ? cells.size() : 0);
  if (!all_of_ranks(divided)) throw Error(ErrorKind::internal, "METIS could not divide the mesh");
  return sorted(scattered(part, cells));
}

}  // namespace fsi
