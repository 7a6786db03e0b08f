#pragma once
// The types of cells a mesh may hold, and their names.

#include <array>
#include <cstddef>
#include <cstdint>

namespace fsi {

/// In 2-D triangles and quads, in 3-D the rest.
enum class CellType : std::int8_t { triangle, quad, tet, hex, prism, pyramid };

/// The type of a cell of that dimension and count of corners.
constexpr CellType type_of(int dim, std::size_t corners) {
  if (dim == 2) return corners == 3 ? CellType::triangle : CellType::quad;
  return corners == 4   ? CellType::tet
         : corners == 8 ? CellType::hex
         : corners == 6 ? CellType::prism
                        : CellType::pyramid;
}

/// What a sentence calls a cell of each type.
inline constexpr std::array<const char*, 6> names_of_cells{"triangle", "quad",  "tet",
                                                           "hex",      "prism", "pyramid"};
/// Its name in words.
constexpr const char* name_of(CellType type) {
  return names_of_cells[static_cast<std::size_t>(type)];
}

}  // namespace fsi
