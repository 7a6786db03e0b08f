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

/// A side as it is told, on its way to the rank that holds its lowest vertex.
Side side_of(const CellList& here, Index half, Index first_cell) {
  const Half h(half);
  Side side{{-1, -1, -1, -1}, first_cell + h.cell, 0};
  std::size_t n = 0;
  for (const std::int8_t i : shape_of(here.types[h.cell]).face_corners(h.face)) {
    side.key[n++] = here.vertex_id[here.corners[h.cell][i]];
  }
  std::ranges::sort(side.key);
  return side;
}

/// Collective. For each of the halves without a mate here the cell that has it elsewhere.
std::vector<Beyond> sought(const CellList& here, const std::vector<Index>& halves,
                           const Stretches& cells, Index n_vertices, const Vec3& axis) {
  const Stretches vertices = Stretches::even(n_vertices);
  std::vector<std::vector<Side>> to(static_cast<std::size_t>(ranks()));
  std::vector<std::vector<std::size_t>> asked(to.size());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    Side side = side_of(here, halves[i], cells.first());
    if (norm(axis) > 0) side.tie = weight_of(here, halves[i], axis);
    const int holder =
        vertices.holder(*std::ranges::find_if(side.key, [](Index v) { return v >= 0; }));
    to[holder].push_back(side), asked[holder].push_back(i);
  }
  const Received<Side> sides = exchange(std::move(to));
  const std::vector<Beyond> found = matched(sides.items);
  std::vector<std::vector<Beyond>> told;
  for (std::size_t r = 0; r + 1 < sides.begin.size(); ++r) {
    told.emplace_back(found.begin() + sides.begin[r], found.begin() + sides.begin[r + 1]);
  }
  const Received<Beyond> answers = exchange(std::move(told));
  std::vector<Beyond> result(halves.size());
  for (std::size_t r = 0; r < asked.size(); ++r) {
    auto answer = answers.items.begin() + answers.begin[r];
    for (const std::size_t i : asked[r]) result[i] = *answer++;
  }
  return result;
}

/// The graph of this rank's cells; ties where `along` is not zero, load where there is a function
/// of it. Neighbours stand in the order of the faces: the same whoever holds the cells.
Graph graph_of(const CellList& here, const Stretches& cells, Index n_vertices, const Vec3& along,
               const CellLoad& load) {
  const bool tied = norm(along) > 0;
  const Vec3 axis = tied ? along / norm(along) : Vec3{};
  const std::vector<Index> mate = match_faces(here);
  std::vector<Index> open;
  for (Index c = 0; c < here.n_cells(); ++c) {
    for (int f = 0; f < shape_of(here.types[c]).faces; ++f) {
      if (mate[half_of(c, f)] < 0) open.push_back(half_of(c, f));
    }
  }
  const std::vector<Beyond> beyond = sought(here, open, cells, n_vertices, axis);
  Graph graph;
  auto next = beyond.begin();
  for (Index c = 0; c < here.n_cells(); ++c) {
    for (int f = 0; f < shape_of(here.types[c]).faces; ++f) {
      const Index half = half_of(c, f), other = mate[half];
      const Beyond far = other < 0 ? *next++ : Beyond{cells.first() + Half(other).cell, 0};
      if (far.cell < 0) continue;
      graph.neighbours.push_back(far.cell);
      if (!tied) continue;
      graph.ties.push_back(other < 0 ? far.tie
                                     : weight_of(here, half, axis) + weight_of(here, other, axis));
    }
    graph.start.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
    if (load) graph.load.push_back(load_units(load(middle(here, c))));
  }
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
  Graph graph = graph_of(here, cells, n_vertices, how.along, how.load);
  if (how.partitioner != "metis") return partition_by_petsc(std::move(graph), how.partitioner);
  graph = gathered(graph);
  std::vector<std::int32_t> part;
  if (rank() == 0) part = divide(graph, ranks());
  const bool divided = static_cast<Index>(part.size()) == (rank() == 0 ? cells.size() : 0);
  if (!all_of_ranks(divided)) throw Error(ErrorKind::internal, "METIS could not divide the mesh");
  return sorted(scattered(part, cells));
}

}  // namespace fsi
