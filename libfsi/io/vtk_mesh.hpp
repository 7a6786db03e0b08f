#pragma once
// The cells of all ranks in the terms of VTK.

#include <cstdint>
#include <span>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi::io {

/// A stretch of the cells in file order and of the points they use, each once, numbered in the
/// order of the mesh as read: rank after rank the same on any number of ranks.
struct VtkMesh {
  std::vector<Real> points;                ///< [points * 3]
  std::vector<std::int64_t> connectivity;  ///< points of the cells, in VTK's order
  /// [cells, on the last rank + 1] where a cell's points begin in the connectivity of all ranks
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;  ///< [cells] VTK's number of the cell type
};

/// Collective. Every rank gets its stretch.
VtkMesh vtk_mesh(const Mesh& mesh);

/// Collective. Every rank gets all of the listed owned cells of each rank, in file order, each with
/// points of its own: for a few.
VtkMesh vtk_cells(const Mesh& mesh, std::span<const Index> cells);

}  // namespace fsi::io
