#pragma once
// Cells by their corners: the form in which a mesh is checked, divided and flattened.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "libfsi/mesh/cells.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// How many periods lie between a point and the vertex it stands for.
using Offset = std::array<std::int8_t, 3>;

/// Cells with all that a Mesh is built from: before the division a stretch of the file (see
/// distribute), afterwards a rank's owned cells and its halo, each sorted by global_id.
struct CellList {
  int dim = 3;                  ///< 2 or 3
  std::vector<Vec3> points;     ///< places of the points
  std::vector<Index> vertex;    ///< [points] in [0, points); the same for points joined by a period
  std::vector<Offset> offset;   ///< [points] x - x(vertex) = sum_k offset[k] periods[k]
  std::vector<Index> point_id;  ///< [points] number in the mesh as read; set by the division
  std::vector<Index> vertex_id;  ///< [points] that of the point `vertex` stands for
  std::vector<CellType> types;   ///< [cells]
  Csr corners;                   ///< [cells] points, ordered as Shape has them
  std::vector<std::array<std::int8_t, max_faces>> face_patch;  ///< [cells] -1: internal
  std::vector<GlobalIndex> global_id;                          ///< [cells]
  Index n_owned = 0;                                           ///< count of owned cells
  std::vector<int> halo_owner;                                 ///< [cells - n_owned] rank
  std::vector<Index> halo_owner_cell;  ///< [cells - n_owned] cell number there
  // the same on every rank
  std::vector<Vec3> periods;         ///< translations that join patches
  std::vector<std::string> patches;  ///< names of the patches
  GlobalIndex n_global = 0;          ///< cells of all ranks
  std::uint64_t hash = 0;            ///< of the mesh as read

  /// Count of cells, halo included.
  Index n_cells() const { return static_cast<Index>(types.size()); }
};

/// A face as one of its cells sees it: half = max_faces * cell + number of the face in the cell.
struct Half {
  Index cell;  ///< local number
  int face;    ///< its number in the cell
  /// Takes it apart.
  explicit Half(Index half) : cell(half / max_faces), face(half % max_faces) {}
};
/// Puts it together.
inline Index half_of(Index cell, int face) { return max_faces * cell + face; }

/// The vertices of a face in ascending order; -1 fills what a face does not have, at the front.
std::array<Index, max_face_corners> face_key(const CellList& list, Half half);

/// Each half's other half: the face of another cell with the same vertices, or no_mate; many_mates
/// where more than two cells share them. Halves a cell does not have are no_mate.
inline constexpr Index no_mate = -1, many_mates = -2;
/// As described above.
std::vector<Index> match_faces(const CellList& list);

/// Cells that touch each vertex: rows [points] of cells, ascending.
Csr cells_of_vertices(const CellList& list);

/// The corner of `cell` that stands for vertex v, as its offset.
const Offset& offset_in(const CellList& list, Index cell, Index v);

/// Row of Mesh::translation for a difference of offsets in {-1, 0, 1}: digits 0, 1, 2 for 0, 1, -1
/// to base 3. Throws Error{internal} for any other difference.
std::int8_t shift_of(const Offset& a, const Offset& b);

/// All translations of up to three periods in the order of shift_of.
std::vector<Vec3> translations(const std::vector<Vec3>& periods);

}  // namespace fsi
