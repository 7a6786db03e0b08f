#pragma once
// The division of cells into parts: METIS on the graph of cells that share a face.

#include <cstdint>
#include <vector>

namespace fsi {

/// Cells that share a face, on one rank, in the form of a CSR matrix.
struct Graph {
  std::vector<std::int32_t> start{0};    ///< [cells + 1]
  std::vector<std::int32_t> neighbours;  ///< cells across the faces
  /// [cells] the column along the path of the solid that each is in, any numbers; empty: none
  std::vector<std::int32_t> column;
  /// [cells] work beyond that of a fluid cell, in any unit; empty: none
  std::vector<std::int32_t> load;

  /// Count of cells.
  std::int32_t cells() const { return static_cast<std::int32_t>(start.size()) - 1; }
};

/// One rank. The part of each cell. Every part gets its share of the cells and, held apart from
/// it, of the load: fluid and solid are worked on one after the other, so each must be balanced by
/// itself. Where the cells are in columns along the path, whole columns are divided, and the
/// balance holds wherever along the path the solid is. Empty where METIS fails.
std::vector<std::int32_t> divide(const Graph& graph, int parts);

}  // namespace fsi
