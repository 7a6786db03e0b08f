#pragma once
// How the interface bends within a cell.

#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// The paraboloid about the plane of a cell, with r from the plane's centre:
///   n . r + (r . K . r - mean) / 2 = 0
/// To first order in its height it leaves the same part of the cell below it as the plane.
struct Bend {
  SymTensor K;    ///< slope of the normal along the plane (cal K of doc/theory/interface.md); zero
                  ///< without a plane
  Real mean = 0;  ///< mean of r . K . r over the plane's part in the cell
};

/// Whether cell c has a bend. Only tetrahedra have one, where a body with planes runs ahead of the
/// flow most. On other cells the memory is enough. Without the memory, a soft disc under a lid has
/// smaller errors with planes.
bool bends(const Mesh& mesh, Index c);
/// Collective. Whether a cell of any rank has a bend.
bool any_cell_bends(const Mesh& mesh);

/// Sets K by a least-squares fit to the normals of the planes around that face the same way; at
/// most 1 over the size of the cell. Works on owned cells of the interface that bend, and sets the
/// halo. symmetry: faces beyond which the planes have images. cell: scratch.
void set_bend(CellField<Bend>& bend, const Interface& interface, const Mesh& mesh,
              const SymmetryFaces& symmetry, geometry::Polytope& cell);

}  // namespace fsi::vof
