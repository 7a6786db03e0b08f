#pragma once
// The division of a mesh over the ranks, by DMPlex and a graph partitioner.

#include <functional>
#include <string>
#include <vector>

#include "libfsi/mesh/cell_list.hpp"

namespace fsi {

/// Work of the cell at this centre, in a mesh of that dimension, beyond that of a fluid cell.
using CellLoad = std::function<Real(const Vec3&, int)>;
/// Collective. The same for a stretch of cells, by their number in the mesh as read: from the
/// first one on, as many as the second argument says.
using CellLoads = std::function<std::vector<Real>(Index, Index)>;

/// How the cells are divided.
struct Division {
  std::string partitioner = "metis";  ///< or ptscotch, simple
  Vec3 along = {};                    ///< direction that metis avoids to cut across; zero: none
  CellLoad load;                      ///< balanced by metis beside the cells; empty: none
  CellLoads loads;                    ///< in place of `load`; empty: `load` counts
};

/// Collective. From the mesh as it is read to its division. `slab`: this rank's stretch of the
/// cells and of the points, both in the order of the mesh as read, corners and vertices by their
/// number in the file. It may be all of it on rank 0, or as much on every rank. What a CellList has
/// the same on every rank is taken from rank 0. Returns this rank's cells and every cell that
/// shares a vertex with one of them. Error{input} for an unknown partitioner.
CellList distribute(CellList slab, const Division& how);

}  // namespace fsi
