#include <petscmat.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/mesh/numbering.hpp"
#include "libfsi/mesh/plex_cells.hpp"

namespace fsi {
namespace {

/// [CuthillMcKee69], turned round: the place of each cell. PETSc reads the graph where it is.
std::vector<Index> reverse_cuthill_mckee(Csr& graph) {
  const Index n = graph.rows();
  std::vector<PetscScalar> values(graph.index.size(), 1);
  Handle<Mat, MatDestroy> matrix;
  Handle<IS, ISDestroy> rows, columns;
  FSI_PETSC(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, graph.offset.data(),
                                      graph.index.data(), values.data(), matrix.out()));
  FSI_PETSC(MatGetOrdering(matrix, MATORDERINGRCM, rows.out(), columns.out()));
  const PetscInt* order = nullptr;
  FSI_PETSC(ISGetIndices(rows, &order));
  std::vector<Index> place(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) place[order[i]] = i;
  FSI_PETSC(ISRestoreIndices(rows, &order));
  return place;
}

/// Each cell goes to its place.
void move_cells(CellList& list, std::span<const Index> place) {
  const auto n = place.size();
  std::vector<Index> from(n);
  for (std::size_t c = 0; c < n; ++c) from[place[c]] = static_cast<Index>(c);
  const auto types = std::exchange(list.types, {});
  const auto face_patch = std::exchange(list.face_patch, {});
  const Csr corners = std::exchange(list.corners, {});
  list.corners.index.reserve(corners.index.size());
  for (const Index c : from) {
    list.types.push_back(types[c]), list.face_patch.push_back(face_patch[c]);
    list.corners.index.insert(list.corners.index.end(), corners[c].begin(), corners[c].end());
    list.corners.offset.push_back(static_cast<Index>(list.corners.index.size()));
  }
}

/// Points in the order in which the cells name them; those of no cell come last.
void move_points(CellList& list) {
  std::vector<Index> place(list.points.size(), -1), from;
  const auto name = [&](Index p) {
    if (place[p] < 0) place[p] = static_cast<Index>(from.size()), from.push_back(p);
  };
  for (const Index p : list.corners.index) name(p);
  for (Index p = 0; p < static_cast<Index>(place.size()); ++p) name(p);
  for (Index& p : list.corners.index) p = place[p];
  const auto points = std::exchange(list.points, {});
  const auto offset = std::exchange(list.offset, {});
  const auto vertex = std::exchange(list.vertex, {});
  for (const Index p : from) {
    list.points.push_back(points[p]), list.offset.push_back(offset[p]);
    list.vertex.push_back(place[vertex[p]]);
  }
}

}  // namespace

Csr cells_across(const CellList& list, std::span<const Index> mate) {
  Csr across;
  for (Index c = 0; c < list.n_cells(); ++c) {
    for (int f = 0; f < shape_of(list.types[c]).faces; ++f) {
      const Index half = mate[half_of(c, f)];
      if (half < 0) continue;
      const Index other = Half(half).cell;
      const Index p = list.corners[c][shape_of(list.types[c]).face_corners(f)[0]];
      if (std::ranges::count(list.corners[other], p) > 0) across.index.push_back(other);
    }
    std::sort(across.index.begin() + across.offset.back(), across.index.end());
    across.offset.push_back(static_cast<Index>(across.index.size()));
  }
  return across;
}

double lines_per_cell(const Csr& across, std::span<const Index> place) {
  constexpr GlobalIndex numbers_a_line = 8, lines = 32;
  std::vector<Index> at(place.size());
  for (std::size_t c = 0; c < place.size(); ++c) at[place[c]] = static_cast<Index>(c);
  GlobalIndex fetched = 0;
  std::vector<GlobalIndex> fetch(place.size() / numbers_a_line + 1, -lines);  // of each line
  const auto read = [&](Index c) {
    GlobalIndex& last = fetch[place[c] / numbers_a_line];
    if (fetched - last >= lines) last = fetched++;
  };
  for (const Index c : at) {
    read(c);
    std::ranges::for_each(across[c], read);
  }
  return static_cast<double>(fetched) / static_cast<double>(place.size());
}

bool number_for_memory(CellList& list, std::span<const Index> mate) {
  Csr across = cells_across(list, mate);
  std::vector<Index> same(list.types.size());
  std::iota(same.begin(), same.end(), 0);
  const std::vector<Index> place = reverse_cuthill_mckee(across);
  if (lines_per_cell(across, same) <= lines_per_cell(across, place)) return false;
  across = {};
  move_cells(list, place);
  move_points(list);
  return true;
}

}  // namespace fsi
