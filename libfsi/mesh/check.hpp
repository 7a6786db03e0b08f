#pragma once
// Every check a mesh must pass before anything is built on it.

#include <string>
#include <vector>

#include "libfsi/mesh/cell_list.hpp"
#include "libfsi/mesh/raw.hpp"

namespace fsi {

/// One rank. Checks the mesh, joins the periodic pairs, names the boundary faces and
/// numbers cells and points (numbering.hpp): the mesh as read. Errors:
/// Error{input}, one sentence that names the file, the entity, where it lies and the valid choices.
CellList check_mesh(RawMesh raw, const std::vector<std::string>& periodic);

}  // namespace fsi
