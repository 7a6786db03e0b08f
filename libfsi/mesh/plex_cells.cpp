#include "libfsi/mesh/plex_cells.hpp"

#include <algorithm>

namespace fsi {
namespace {

DMPolytopeType polytope(CellType type) {
  constexpr DMPolytopeType of[] = {DM_POLYTOPE_TRIANGLE,    DM_POLYTOPE_QUADRILATERAL,
                                   DM_POLYTOPE_TETRAHEDRON, DM_POLYTOPE_HEXAHEDRON,
                                   DM_POLYTOPE_TRI_PRISM,   DM_POLYTOPE_PYRAMID};
  return of[static_cast<std::size_t>(type)];
}

/// Each value becomes the largest that a rank has for the same vertex.
void agree(PetscSF directory, std::vector<PetscInt>& values, Index n_roots) {
  std::vector<PetscInt> roots(static_cast<std::size_t>(n_roots), -1);
  FSI_PETSC(PetscSFReduceBegin(directory, MPIU_INT, values.data(), roots.data(), MPI_MAX));
  FSI_PETSC(PetscSFReduceEnd(directory, MPIU_INT, values.data(), roots.data(), MPI_MAX));
  FSI_PETSC(PetscSFBcastBegin(directory, MPIU_INT, roots.data(), values.data(), MPI_REPLACE));
  FSI_PETSC(PetscSFBcastEnd(directory, MPIU_INT, roots.data(), values.data(), MPI_REPLACE));
}

/// Sets which vertices of the plex other ranks own: the highest rank that has one.
void share_vertices(DM plex, PetscInt n_cells, Index n_vertices,
                    const std::vector<Index>& vertices) {
  const Stretches where = Stretches::even(n_vertices);
  std::vector<PetscSFNode> root;
  for (const Index v : vertices) {
    const int holder = where.holder(v);
    root.push_back({holder, v - where.begin[static_cast<std::size_t>(holder)]});
  }
  StarForest directory, shared;
  FSI_PETSC(PetscSFCreate(comm(), directory.out()));
  FSI_PETSC(PetscSFSetGraph(directory, where.mine(), static_cast<PetscInt>(root.size()), nullptr,
                            PETSC_COPY_VALUES, root.data(), PETSC_COPY_VALUES));
  std::vector<PetscInt> owner(vertices.size(), rank()), point(vertices.size(), -1);
  agree(directory, owner, where.mine());
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (owner[i] == rank()) point[i] = n_cells + static_cast<PetscInt>(i);
  }
  agree(directory, point, where.mine());
  std::vector<PetscInt> leaf;
  root.clear();
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (owner[i] == rank()) continue;
    leaf.push_back(n_cells + static_cast<PetscInt>(i));
    root.push_back({owner[i], point[i]});
  }
  FSI_PETSC(PetscSFCreate(comm(), shared.out()));
  const auto n_points = n_cells + static_cast<PetscInt>(vertices.size());
  FSI_PETSC(PetscSFSetGraph(shared, n_points, static_cast<PetscInt>(leaf.size()), leaf.data(),
                            PETSC_COPY_VALUES, root.data(), PETSC_COPY_VALUES));
  FSI_PETSC(DMSetPointSF(plex, shared));
}

}  // namespace

std::vector<Index> compress(std::vector<Index>& numbers) {
  std::vector<Index> distinct(numbers);
  std::ranges::sort(distinct);
  const auto twice = std::ranges::unique(distinct);
  distinct.erase(twice.begin(), twice.end());
  for (Index& number : numbers) {
    number = static_cast<Index>(std::ranges::lower_bound(distinct, number) - distinct.begin());
  }
  return distinct;
}

Plex plex_of(const NumberedCells& cells, Index n_vertices, std::vector<Index>& vertices) {
  const auto n_cells = static_cast<PetscInt>(cells.types.size());
  Csr corners = cells.vertices;
  vertices = compress(corners.index);
  const auto n = n_cells + static_cast<PetscInt>(vertices.size());
  Plex plex;
  FSI_PETSC(DMPlexCreate(comm(), plex.out()));
  FSI_PETSC(DMSetDimension(plex, cells.dim));
  FSI_PETSC(DMPlexDistributeSetDefault(plex, PETSC_FALSE));
  FSI_PETSC(DMPlexSetChart(plex, 0, n));
  FSI_PETSC(DMCreateLabel(plex, "celltype"));  // else PETSc guesses the types, too early
  for (PetscInt c = 0; c < n_cells; ++c) {
    FSI_PETSC(DMPlexSetConeSize(plex, c, shape_of(cells.types[c]).corners));
    FSI_PETSC(DMPlexSetCellType(plex, c, polytope(cells.types[c])));
  }
  for (PetscInt v = n_cells; v < n; ++v) FSI_PETSC(DMPlexSetCellType(plex, v, DM_POLYTOPE_POINT));
  FSI_PETSC(DMSetUp(plex));
  for (PetscInt c = 0; c < n_cells; ++c) {
    PetscInt cone[max_corners];
    int i = 0;
    for (const Index v : corners[c]) cone[i++] = n_cells + v;
    FSI_PETSC(DMPlexReorderCell(plex, c, cone));
    FSI_PETSC(DMPlexSetCone(plex, c, cone));
  }
  FSI_PETSC(DMPlexSymmetrize(plex));
  FSI_PETSC(DMPlexStratify(plex));
  share_vertices(plex, n_cells, n_vertices, vertices);
  return plex;
}

}  // namespace fsi
