#pragma once
// The cells of all ranks in the terms of VTK.

#include <cstdint>
#include <span>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi::io {

/// Cells in file order with the points they use, each once, numbered as the cells first name them:
/// the same on any number of ranks.
struct VtkMesh {
  std::vector<Real> points;                ///< [points * 3]
  std::vector<std::int64_t> connectivity;  ///< points of the cells, in VTK's order
  std::vector<std::int64_t> offsets;       ///< [cells + 1] where a cell's points begin
  std::vector<std::uint8_t> types;         ///< [cells] VTK's number of the cell type
};

/// Collective. Rank 0 gets the mesh, the others an empty one.
VtkMesh vtk_mesh(const Mesh& mesh);
/// The same of some of the owned cells of each rank.
VtkMesh vtk_mesh(const Mesh& mesh, std::span<const Index> cells);

}  // namespace fsi::io
