#pragma once
// The cells a mesh may hold: corners, faces and how gmsh numbers them.

#include <array>
#include <cstdint>
#include <span>

#include "libfsi/core/types.hpp"
#include "libfsi/mesh/cell_type.hpp"

namespace fsi {

/// A cell has at most that many corners and faces, a face that many corners.
inline constexpr int max_corners = 8, max_faces = 6, max_face_corners = 4;

/// The corners of each face, right-handed about the outward normal (2-D: the edge, interior on its
/// left). Corner numbers are those of the gmsh file format; a face ends at its first -1.
struct Shape {
  int dim;                                                                ///< 2 or 3
  int corners;                                                            ///< count of corners
  int faces;                                                              ///< count of faces
  std::array<std::array<std::int8_t, max_face_corners>, max_faces> face;  ///< corners of each face

  /// Corners of face f.
  std::span<const std::int8_t> face_corners(int f) const {
    const auto& list = face[static_cast<std::size_t>(f)];
    std::size_t n = 2;
    while (n < max_face_corners && list[n] >= 0) ++n;
    return {list.data(), n};
  }
};

/// Of each CellType, in its order.
inline constexpr std::array<Shape, 6> shapes_of_cells{{
    {2, 3, 3, {{{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 0, -1, -1}}}},
    {2, 4, 4, {{{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}}}},
    {3, 4, 4, {{{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}}},
    {3,
     8,
     6,
     {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}},
    {3, 6, 5, {{{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}},
    {3, 5, 5, {{{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}},
}};

/// The shape of a type.
constexpr const Shape& shape_of(CellType type) {
  return shapes_of_cells[static_cast<std::size_t>(type)];
}

}  // namespace fsi
