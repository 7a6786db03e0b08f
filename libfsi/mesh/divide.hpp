#pragma once
// Which part takes which cell: METIS on the graph of cells that share a face.

#include <cstdint>
#include <vector>

namespace fsi {

/// Cells that share a face, on one rank, in the form of a CSR matrix.
struct Graph {
  std::vector<std::int32_t> start{0};    ///< [cells + 1]
  std::vector<std::int32_t> neighbours;  ///< cells across the faces
  /// beside neighbours: 2 where the way across is normal to the path of the solid, 2 * slender
  /// where it goes along; empty: all ways are alike
  std::vector<std::int32_t> ties;
  /// [cells] work beyond that of a fluid cell, in any unit; empty: none
  std::vector<std::int32_t> load;

  std::int32_t cells() const { return static_cast<std::int32_t>(start.size()) - 1; }
};

/// Weight of a face across the path against one beside it.
inline constexpr int slender = 8;

/// One rank. The part of each cell. Every part gets its share of the cells and, held apart from
/// it, of the load: fluid and solid are worked on one after the other, so each must be balanced by
/// itself. Where the cells form rows along the path (extruded and mapped meshes), whole rows are
/// divided, and the balance holds wherever along the path the solid is. Empty where METIS fails.
std::vector<std::int32_t> divide(const Graph& graph, int parts);

}  // namespace fsi
