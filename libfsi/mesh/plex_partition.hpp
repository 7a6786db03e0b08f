#pragma once
// Which rank takes which cell.

#include <petscsys.h>

#include <vector>

#include "libfsi/mesh/cell_list.hpp"
#include "libfsi/mesh/plex.hpp"

namespace fsi {

/// The cells of each part, part after part; empty on every rank but the first.
struct Parts {
  std::vector<PetscInt> sizes;  ///< [ranks]
  std::vector<PetscInt> cells;
};

/// Collective. Divides the graph of cells that share a face (across a period too), which lies on
/// rank 0: metis by `divide`, with the load and the direction of `how`; ptscotch and simple, which
/// are PETSc's, without.
Parts partition_cells(const CellList& whole, const Division& how);

}  // namespace fsi
