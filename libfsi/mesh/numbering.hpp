#pragma once
// The order in which cells and points are numbered: neighbours in space are neighbours in memory.

#include <span>

#include "libfsi/mesh/cell_list.hpp"

namespace fsi {

/// For each cell those across its faces, ascending; a period joins none. `mate`: match_faces.
Csr cells_across(const CellList& list, std::span<const Index> mate);

/// Lines of memory that a walk through the cells fetches per cell. The walk reads one number of
/// each cell in turn and of the cells across its faces; place[c] is where the number of cell c
/// stands. The memory has lines of 8 numbers. The cache holds the last 32 lines fetched, about what
/// one array has of a first-level cache of 32 KiB when a kernel walks through 16. At least 1/8.
double lines_per_cell(const Csr& across, std::span<const Index> place);

/// One rank, before the division. Numbers cells and points anew where that saves fetches: the cells
/// in the reverse order of [CuthillMcKee69], the points as the cells name them. Leaves a list alone
/// whose own order needs no more lines. On return the list holds the same mesh in the new order,
/// from which global_id counts and the hash is to be taken. Returns whether it changed.
bool number_for_memory(CellList& list, std::span<const Index> mate);

}  // namespace fsi
