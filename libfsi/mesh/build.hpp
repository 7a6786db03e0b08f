#pragma once
// From cells by their corners to the flat arrays of a Mesh.

#include "libfsi/mesh/cell_list.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// Collective. The Mesh of this rank's cells. `list` holds every cell that shares a vertex with an
/// owned one. On return all arrays are as mesh.hpp says.
Mesh build_mesh(CellList list);

}  // namespace fsi
