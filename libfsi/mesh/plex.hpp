#pragma once
// The division of a mesh over the ranks, by DMPlex and a graph partitioner.

#include <string>

#include "libfsi/mesh/cell_list.hpp"

namespace fsi {

/// Collective. Takes all cells on rank 0 (the other ranks' `whole` is ignored) and gives each rank
/// its own and every cell that shares a vertex with one of them. partitioner: metis, ptscotch or
/// simple; Error{input} for any other. metis avoids to cut across `along`. One rank: `whole`
/// itself.
CellList distribute(CellList whole, const std::string& partitioner, const Vec3& along = {});

}  // namespace fsi
