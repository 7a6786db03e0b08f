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

/// A face as one of its cells tells it to the rank where both meet.
struct Side {
  std::array<Index, max_face_corners> key;  // vertices by number in the file, ascending
  Index cell;                               // number in the file
  std::int32_t tie;
};
/// What it is told: the cell on the other side (-1: none) and the sum of the ties.
struct Beyond {
  Index cell;
  std::int32_t tie;
};

std::vector<Beyond> matched(const std::vector<Side>& sides) {
  std::vector<Beyond> answers(sides.size(), {-1, 0});
  std::vector<std::size_t> order(sides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(
      order, {}, [&](std::size_t i) -> const auto& { return sides[i].key; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    const std::size_t i = order[k - 1], j = order[k];
    if (sides[i].key != sides[j].key) continue;
    const std::int32_t tie = sides[i].tie + sides[j].tie;
    answers[i] = {sides[j].cell, tie}, answers[j] = {sides[i].cell, tie};
  }
  return answers;
}

/// The sides of this rank's cells, each on its way to the rank that holds its lowest vertex.
std::vector<std::vector<Side>> sides_of(const CellList& here, const Stretches& cells,
                                        const Stretches& vertices, const Vec3& axis) {
  std::vector<std::vector<Side>> to(static_cast<std::size_t>(ranks()));
  const bool tied = norm(axis) > 0;
  for (Index c = 0; c < here.n_cells(); ++c) {
    const Shape& shape = shape_of(here.types[c]);
    for (int f = 0; f < shape.faces; ++f) {
      Side side{{-1, -1, -1, -1}, cells.first() + c, 0};
      std::size_t n = 0;
      for (const std::int8_t i : shape.face_corners(f)) {
        side.key[n++] = here.vertex_id[here.corners[c][i]];
      }
      const int holder = vertices.holder(*std::min_element(side.key.begin(), side.key.begin() + n));
      std::ranges::sort(side.key);
      if (tied) side.tie = weight_of(here, half_of(c, f), axis);
      to[holder].push_back(side);
    }
  }
  return to;
}

/// The graph of this rank's cells; ties where `along` is not zero, load where there is a function
/// of it. The same whoever holds the cells.
Graph graph_of(const CellList& here, const Stretches& cells, Index n_vertices, const Vec3& along,
               const CellLoad& load) {
  const bool tied = norm(along) > 0;
  const Vec3 axis = tied ? along / norm(along) : Vec3{};
  const Stretches vertices = Stretches::even(n_vertices);
  std::vector<std::vector<Beyond>> answers;
  std::vector<std::vector<std::int32_t>> asked(static_cast<std::size_t>(ranks()));  // cells
  {
    const auto to = sides_of(here, cells, vertices, axis);
    for (std::size_t r = 0; r < to.size(); ++r) {
      for (const Side& side : to[r]) asked[r].push_back(side.cell - cells.first());
    }
    const auto from = exchange(to);
    std::vector<std::vector<Beyond>> told;
    std::vector<Side> all;
    for (const auto& sides : from) all.insert(all.end(), sides.begin(), sides.end());
    const std::vector<Beyond> found = matched(all);
    auto at = found.begin();
    for (const auto& sides : from) {
      told.emplace_back(at, at + static_cast<std::ptrdiff_t>(sides.size()));
      at += static_cast<std::ptrdiff_t>(sides.size());
    }
    answers = exchange(told);
  }
  Graph graph;
  graph.start.assign(here.types.size() + 1, 0);
  for (std::size_t r = 0; r < asked.size(); ++r) {
    for (std::size_t i = 0; i < asked[r].size(); ++i) {
      if (answers[r][i].cell >= 0) ++graph.start[asked[r][i] + 1];
    }
  }
  std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
  graph.neighbours.resize(graph.start.back()), graph.ties.resize(tied ? graph.start.back() : 0);
  std::vector<std::int32_t> next(graph.start.begin(), graph.start.end() - 1);
  for (std::size_t r = 0; r < asked.size(); ++r) {
    for (std::size_t i = 0; i < asked[r].size(); ++i) {
      if (answers[r][i].cell < 0) continue;
      const std::int32_t at = next[asked[r][i]]++;
      graph.neighbours[at] = answers[r][i].cell;
      if (tied) graph.ties[at] = answers[r][i].tie;
    }
  }
  for (Index c = 0; load && c < here.n_cells(); ++c) {
    graph.load.push_back(load_units(load(middle(here, c))));
  }
  return graph;
}

/// Collective. Everybody's items, rank after rank, on rank 0.
std::vector<std::int32_t> gathered(const std::vector<std::int32_t>& mine) {
  std::vector<std::vector<std::int32_t>> to(static_cast<std::size_t>(ranks()));
  to[0] = mine;
  std::vector<std::int32_t> all;
  for (const auto& items : exchange(to)) all.insert(all.end(), items.begin(), items.end());
  return all;
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
  whole.ties = gathered(mine.ties), whole.load = gathered(mine.load);
  if (std::ranges::none_of(whole.load, [](std::int32_t l) { return l > 0; })) whole.load.clear();
  return whole;
}

/// Collective. Each rank's stretch of what rank 0 holds.
std::vector<std::int32_t> scattered(const std::vector<std::int32_t>& all, const Stretches& cells) {
  std::vector<std::vector<std::int32_t>> to(static_cast<std::size_t>(ranks()));
  for (std::size_t r = 0; r < to.size() && !all.empty(); ++r) {
    to[r].assign(all.begin() + cells.begin[r], all.begin() + cells.begin[r + 1]);
  }
  return exchange(to)[0];
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
  Graph graph = graph_of(here, cells, n_vertices, how.along, how.load);
  if (how.partitioner != "metis") return partition_by_petsc(std::move(graph), how.partitioner);
  graph = gathered(graph);
  std::vector<std::int32_t> part;
  if (rank() == 0) part = divide(graph, ranks());
  const bool divided = static_cast<Index>(part.size()) == (rank() == 0 ? cells.size() : 0);
  if (!all_of_ranks(divided)) throw Error(Kind::internal, "METIS could not divide the mesh");
  return sorted(scattered(part, cells));
}

}  // namespace fsi
