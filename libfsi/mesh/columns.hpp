#pragma once
// Columns of cells along an axis.

#include <cstdint>
#include <vector>

#include "libfsi/mesh/cell_list.hpp"

namespace fsi {

/// Mean of the corners of a cell.
Vec3 middle(const CellList& list, Index cell);

/// Collective. The column of each of this rank's cells, a number that is the same whoever holds
/// them: which square of a grid normal to `along` the cell's middle is projected into. The squares
/// are half a cell wide on average, so that rows of an extruded mesh have columns of their own. The
/// border of a set of columns is then as smooth as the cells allow. along: not zero.
std::vector<std::int32_t> columns_of(const CellList& here, const Vec3& along);

}  // namespace fsi
