#pragma once
// The mesh for the kernels: flat arrays, filled once, never changed.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/mesh/cell_type.hpp"
#include "libfsi/mesh/halo.hpp"

struct _p_DM;  // PETSc's: its DM is a _p_DM* NOLINT(bugprone-reserved-identifier)

namespace fsi {

/// Rows of indices: row i is index[offset[i]] .. index[offset[i + 1]].
struct Csr {
  std::vector<Index> offset{0};  ///< begin of each row, and the end of the last
  std::vector<Index> index;      ///< the rows, one after the other

  /// Count of rows.
  Index rows() const { return static_cast<Index>(offset.size()) - 1; }
  /// Row i.
  std::span<const Index> operator[](Index i) const {
    return {index.data() + offset[i], static_cast<std::size_t>(offset[i + 1] - offset[i])};
  }
};

/// Boundary faces [begin, end) that carry one physical name. On a rank without such faces the patch
/// is there and empty: every rank holds the same names in the same order.
struct Patch {
  std::string name;          ///< physical name in the gmsh file
  Index begin = 0, end = 0;  ///< its faces, the last not included
};

/// One rank's part of the mesh.
///
/// Cells: [0, n_owned) owned, [n_owned, n_cells) halo (all cells that share a vertex with an owned
/// one). Both parts are sorted by global_id, which does not depend on the number of ranks: the
/// order of the file, or that of number_for_memory. Faces: every face of an owned cell, and no
/// other. [0, n_internal) internal, then the boundary faces patch by patch. The owner P of an
/// internal face is the cell with the lower global_id, so orientation is the same on all ranks;
/// either cell may be a halo cell. Faces are sorted by (global_id of owner, of neighbour). Periodic
/// pairs are internal faces; only `d`, `shift` and `translation` show the period. 2-D: cells are
/// polygons in the plane z = 0, V is an area, faces are edges, |Sf| a length.
struct Mesh {
  int dim = 3;                                                  ///< 2 or 3
  Index n_owned = 0, n_cells = 0, n_internal = 0, n_faces = 0;  ///< counts on this rank, as above
  GlobalIndex n_global = 0;                                     ///< cells of all ranks

  // faces
  std::vector<Index> owner;      ///< [n_faces] P
  std::vector<Index> neighbour;  ///< [n_internal] N
  std::vector<Vec3> Sf;          ///< [n_faces] area vector, from P to N or outward
  std::vector<Vec3> Cf;          ///< [n_faces] centroid, in the frame of P
  /// [n_faces] C_N - C_P (image of N next to P); boundary: Cf - C_P
  std::vector<Vec3> d;
  /// [n_internal] row of `translation`: next to P the centre of N is C[N] + translation[shift]
  std::vector<Index> shift;
  /// [n_faces] corners in order, right-handed about Sf (2-D: the two ends), frame of P
  Csr face_points;
  std::vector<Patch> patches;  ///< cover [n_internal, n_faces)

  // cells
  std::vector<Vec3> C;                 ///< [n_cells] centroid
  std::vector<Real> V;                 ///< [n_cells] volume, area in 2-D
  std::vector<GlobalIndex> global_id;  ///< [n_cells] number in the mesh as read, from 0
  Csr cell_faces;                      ///< [n_owned] faces of the cell, ascending
  /// [n_owned] cells that share a vertex, itself excluded, sorted by (global_id, shift)
  Csr cell_neighbours;
  /// in the order of cell_neighbours.index: next to this cell, that one is at C[n] +
  /// translation[shift]
  std::vector<std::int8_t> cell_neighbour_shift;

  // points
  std::vector<Vec3> points;     ///< corners of owned and halo cells
  Csr cell_points;              ///< [n_cells] corners, in the order of the gmsh format
  std::vector<Index> vertex;    ///< [points] the same number for points joined by a period
  std::vector<Index> point_id;  ///< [points] number in the mesh as read, from 0
  std::vector<Index>
      vertex_id;  ///< [points] that of the one point all joined by a period stand for
  std::vector<Vec3> translation{Vec3{}};  ///< row 0 is zero

  Halo halo;               ///< exchange of cell values between ranks
  Real total_volume = 0;   ///< of all ranks
  std::uint64_t hash = 0;  ///< of the mesh as read; a checkpoint of another mesh is refused

  /// Count of boundary faces on this rank.
  Index n_boundary() const { return n_faces - n_internal; }
  /// Whether a cell is a triangle or a tetrahedron, a quadrilateral or a hexahedron.
  bool simplex(Index c) const { return static_cast<int>(cell_points[c].size()) == dim + 1; }
  /// Whether a cell is a quadrilateral or a hexahedron.
  bool brick(Index c) const { return static_cast<int>(cell_points[c].size()) == 1 << dim; }
  /// The kind of a cell.
  CellType type(Index c) const { return type_of(dim, cell_points[c].size()); }

  /// Unit normal of face f, from P to N or outward.
  Vec3 normal(Index f) const { return Sf[f] / norm(Sf[f]); }
  /// Corner i of face f as seen from cell c (its owner, or its neighbour across a period).
  Vec3 corner(Index f, Index i, Index c) const {
    const Vec3 x = points[face_points.index[face_points.offset[f] + i]];
    return f >= n_internal || owner[f] == c ? x : x - translation[shift[f]];
  }
  /// The same for the centroid of face f.
  Vec3 face_centre(Index f, Index c) const {
    return f >= n_internal || owner[f] == c ? Cf[f] : Cf[f] - translation[shift[f]];
  }
  /// The patch of that name; throws Error{input} that lists the names of the mesh.
  const Patch& patch(const std::string& name) const;

  /// Collective at its first call, which makes it: the mesh as a DMPlex of PETSc, which this owns.
  /// Cell c < n_owned is cell c of the DM; on more than one rank the cells that share a vertex with
  /// one of them follow as overlap. Faces and edges are there; the label "Face Sets" holds 1 + its
  /// patch on a boundary face, a label of the patch's name the same. Points joined by a period are
  /// one vertex, and cells at the seam have coordinates of their own (DMGetCellCoordinates).
  _p_DM* dm() const;

 private:
  mutable std::shared_ptr<_p_DM> plex_;
};

}  // namespace fsi
