#pragma once
// A mesh as it is in its file, on one rank.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "libfsi/mesh/cells.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// What a gmsh file holds, with nodes numbered from 0. Nothing of it is checked but the numbers of
/// nodes.
struct RawMesh {
  /// A boundary element and its physical name; -1 fills corners it does not have.
  struct Side {
    std::array<Index, max_face_corners> corner{-1, -1, -1, -1};  ///< nodes
    Index name = -1;                                             ///< in `names`; -1: none
    std::int64_t tag = 0;                                        ///< number in the file
  };
  /// Nodes that $Periodic of a file joins, on an entity of dimension `dim`: (node, master node).
  struct Link {
    int dim = 0;                                 ///< of the entity
    std::vector<std::pair<Index, Index>> nodes;  ///< pairs
  };

  std::string file;                      ///< its name
  int dim = 3;                           ///< 2 or 3
  std::vector<Vec3> points;              ///< places of the nodes
  std::vector<std::int64_t> point_tags;  ///< [points] number in the file
  std::vector<CellType> types;           ///< [cells] in the order of the file
  Csr corners;                           ///< [cells] nodes in the order of the file format
  std::vector<std::int32_t> entities;    ///< [cells] the geometric entity a cell belongs to
  std::vector<std::int64_t> tags;        ///< [cells] number in the file
  std::vector<Side> sides;               ///< elements of the boundary
  std::vector<std::string> names;        ///< physical names of the boundary
  std::vector<Link> links;               ///< periodic nodes

  /// Count of cells.
  Index n_cells() const { return static_cast<Index>(types.size()); }
};

}  // namespace fsi
