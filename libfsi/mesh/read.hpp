#pragma once
// From a gmsh file to a distributed Mesh.

#include <string>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// What to read and how to divide it.
struct MeshOptions {
  std::string file;  ///< gmsh 2.2 or 4.x, ascii or binary
  std::vector<std::string>
      periodic;  ///< pairs of physical names joined by translation: a, b[, c, d ...]
  std::string partitioner = "metis";  ///< or ptscotch, simple
  Vec3 along = {};                    ///< direction that metis avoids to cut across; zero: none
};

/// Collective. Reads, checks, partitions and flattens the mesh. Errors: Error{input}, one sentence
/// that names the file, the entity and the valid choices.
Mesh read_mesh(const MeshOptions& options);

}  // namespace fsi
