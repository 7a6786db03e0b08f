#pragma once
// Mesh files of fsi-mesh convert: HDF5, read by every rank in its own stretches.

#include <string>
#include <vector>

#include "libfsi/mesh/cell_list.hpp"

namespace fsi {

/// Whether a file's name says that it is one of these: it ends in .h5.
bool is_mesh_file(const std::string& file);

/// One rank. Adds the group "/fsi" to the HDF5 file, which must exist: cells by their corners,
/// points, names of the boundary faces, periodic pairs and the hash of the whole mesh. The list
/// `periodic` names the patches that were joined. Errors: Error{io}.
void write_mesh_tables(const std::string& file, const CellList& whole,
                       const std::vector<std::string>& periodic);

/// Collective. This rank's stretch of the cells and points of "/fsi", in the terms of distribute.
/// periodic: empty, or the pairs the file was made with. Errors: Error{input}, one sentence that
/// names the file and what is wrong with it.
CellList read_mesh_tables(const std::string& file, const std::vector<std::string>& periodic);

}  // namespace fsi
