#pragma once
// The mesh as PETSc's tools want it: a DMPlex with coordinates, faces, edges and labels.

#include <petscdm.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "libfsi/mesh/mesh.hpp"
#include "libfsi/mesh/plex_cells.hpp"

namespace fsi {

/// A face of the boundary: its patch and its vertices by number; -1 fills what it does not have.
struct BoundaryFace {
  Index patch;                                                   ///< its number
  std::array<Index, max_face_corners> vertices{-1, -1, -1, -1};  ///< by number
};

/// Collective. The cells with all their faces, edges and vertices; x: place of a vertex by number.
/// Label "Face Sets" holds 1 + patch on boundary faces, a label of each patch's name the same.
Plex interpolated(const NumberedCells& cells, Index n_vertices, const std::function<Vec3(Index)>& x,
                  const std::vector<BoundaryFace>& faces, const std::vector<std::string>& patches);

/// Collective. What Mesh::dm promises, made anew.
std::shared_ptr<_p_DM> make_dm(const Mesh& mesh);

}  // namespace fsi
