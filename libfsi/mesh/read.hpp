#pragma once
// From a mesh file to a distributed Mesh.

#include <functional>
#include <string>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// What to read and how to divide it.
struct MeshOptions {
  std::string file;  ///< gmsh 2.2 or 4.x, ascii or binary; or .h5 of fsi-mesh convert
  std::vector<std::string>
      periodic;  ///< pairs of physical names joined by translation: a, b[, c, d ...]
  std::string partitioner = "metis";  ///< or ptscotch, simple
  Vec3 along = {};                    ///< direction that metis avoids to cut across; zero: none
  /// Work of the cell at this centre, in a mesh of that dimension, beyond that of a fluid cell. Any
  /// unit will do: metis gives every rank its share of it, and its share of the cells besides.
  /// Empty: none.
  std::function<Real(const Vec3& x, int dim)> load = {};
  /// Collective. The same by the number of a cell in the mesh as read (Mesh::global_id): of as many
  /// cells as the second argument says, from the first one on. Empty: `load` counts.
  std::function<std::vector<Real>(Index, Index)> loads = {};
};

/// Collective. Reads, checks, partitions and flattens the mesh. A gmsh file passes through rank 0;
/// of an .h5 file every rank reads its own stretch, and no rank holds the whole. Errors:
/// Error{input}, one sentence that names the file, the entity and the valid choices.
Mesh read_mesh(const MeshOptions& options);

}  // namespace fsi
