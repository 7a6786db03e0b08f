#pragma once
// From a gmsh file to one that every rank reads its own part of.

#include <cstdint>
#include <string>
#include <vector>

namespace fsi {

/// Collective; rank 0 does the work and needs the memory of a whole mesh. Reads and checks the gmsh
/// file `from`, joins the patches `periodic` in pairs and writes `to`, an HDF5 file with
/// - what PETSc's DMPlexTopologyLoad, CoordinatesLoad and LabelsLoad read of a DM named "fsi":
/// cells,
///   faces, edges, vertices, "Face Sets" and a label for each patch; periodic sides are not joined;
/// - the group "/fsi", from which read_mesh takes the mesh, periodic pairs joined.
/// The file is whole or not there. Returns the count of cells. Errors: Error{input} for the gmsh
/// file and for a name that does not end in .h5, Error{io}.
std::int64_t convert_mesh(const std::string& from, const std::string& to,
                          const std::vector<std::string>& periodic);

}  // namespace fsi
