#pragma once
// Which rank takes which cell.

#include <petscsys.h>

#include <string>
#include <vector>

#include "libfsi/mesh/cell_list.hpp"

namespace fsi {

/// The cells of each part, part after part; empty on every rank but the first.
struct Parts {
  std::vector<PetscInt> sizes;  ///< [ranks]
  std::vector<PetscInt> cells;
};

/// Collective. Divides the graph of cells that share a face (across a period too), which lies on
/// rank 0, with a partitioner of PETSc: metis (ours), ptscotch or simple. metis avoids cuts across
/// the direction `along` (zero: none): parts up to about `slender` times as long as wide cost no
/// more than compact ones.
Parts partition_cells(const CellList& whole, const std::string& partitioner, const Vec3& along);

/// Weight of a face across `along` against one beside it.
inline constexpr int slender = 8;

}  // namespace fsi
