#pragma once
// How the interface bends within a cell.

#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// The paraboloid about the plane of a cell, r from the plane's centre, that leaves the same part
/// of the cell below it to the order of its height:
///   h(r) = n . r + (r . K . r - mean) / 2 = 0
struct Bend {
  SymTensor K;    ///< slope of the normal along the plane; zero where there is no plane
  Real mean = 0;  ///< of r . K . r over the plane's part in the cell
};

/// Whether cell c has a bend: a tetrahedron, where planes let a body run ahead most. On other cells
/// the memory of the shape is enough, and without it a soft disc under a lid fares better with
/// planes.
bool bends(const Mesh& mesh, Index c);
/// Collective. Whether one of them does on any rank.
bool any_cell_bends(const Mesh& mesh);

/// K by least squares over the normals of the planes around, those on the same side of the solid;
/// at most 1 over the size of the cell. Sets owned cells of the interface that bend, and the halo.
/// cell: scratch.
void set_bend(CellField<Bend>& bend, const Interface& interface, const Mesh& mesh,
              geometry::Polytope& cell);

}  // namespace fsi::vof
