#pragma once
// The division of a mesh over the ranks, by DMPlex and a graph partitioner.

#include <functional>
#include <string>

#include "libfsi/mesh/cell_list.hpp"

namespace fsi {

/// Work of the cell at this centre beyond that of a fluid cell; 0 where there is none.
using CellLoad = std::function<Real(const Vec3&)>;

/// How the cells are divided.
struct Division {
  std::string partitioner = "metis";  ///< or ptscotch, simple
  Vec3 along = {};                    ///< direction that metis avoids to cut across; zero: none
  CellLoad load;                      ///< balanced by metis beside the cells; empty: none
};

/// Collective. Takes all cells on rank 0 (the other ranks' `whole` is ignored) and gives each rank
/// its own and every cell that shares a vertex with one of them. Error{input} for an unknown
/// partitioner. One rank: `whole` itself.
CellList distribute(CellList whole, const Division& how);

}  // namespace fsi
