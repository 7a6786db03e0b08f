#pragma once
// The division of cells among ranks.

#include <petscsys.h>

#include <vector>

#include "libfsi/mesh/cell_list.hpp"
#include "libfsi/mesh/exchange.hpp"
#include "libfsi/mesh/plex.hpp"

namespace fsi {

/// Where this rank's stretch of cells goes: the cells of each part, part after part.
struct Parts {
  std::vector<PetscInt> sizes;  ///< [ranks]
  std::vector<PetscInt> cells;  ///< counted from the first of the stretch
};

/// Collective. Divides the graph of cells that share a face (across a period too): metis by
/// `divide` on rank 0, which has the whole graph for that time (some 60 bytes a cell). It takes the
/// load and the direction of `how`. With ptscotch and simple, which are PETSc's, each rank has its
/// own cells, and there is no load. `here`: the stretch of cells with its points; n_vertices: in
/// the file.
Parts partition_cells(const CellList& here, const Stretches& cells, Index n_vertices,
                      const Division& how);

}  // namespace fsi
