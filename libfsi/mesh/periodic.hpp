#pragma once
// Periodic pairs: which nodes of a mesh are one vertex.

#include <string>
#include <vector>

#include "libfsi/mesh/cell_list.hpp"
#include "libfsi/mesh/raw.hpp"

namespace fsi {

/// Nodes joined across periods, in the terms of CellList.
struct PeriodicPairs {
  std::vector<Index> vertex;   ///< [points]
  std::vector<Offset> offset;  ///< [points]
  std::vector<Vec3> periods;   ///< translations
};

/// Joins the nodes that $Periodic of the file pairs and those of `pairs` (names a, b, c, d: a with
/// b, c with d), by translation. Moves the joined nodes onto the exact image of their vertex, so
/// that a face is the same from both sides. Errors: Error{input} for unknown names, an odd count,
/// nodes without image, anything but a translation.
PeriodicPairs join_periodic(RawMesh& raw, const std::vector<std::string>& pairs);

/// Error{input} where a cell meets itself or one neighbour twice: fewer than 3 cells across a
/// period.
void check_periods(const CellList& list, const std::string& file);

}  // namespace fsi
