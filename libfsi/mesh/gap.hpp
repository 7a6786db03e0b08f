#pragma once
// The number of cells across the narrowest passage of a mesh.

#include <string>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// The narrowest passage between two walls, counted in cells.
struct Gap {
  Real cells = 0;        ///< 0: no wall faces another one
  Real width = 0;        ///< its length, from wall to wall
  Vec3 x{};              ///< the middle of it; behind a plane of symmetry where it meets the plane
  std::string from, to;  ///< the patches on either side
};

/// The edge of a cell: that of the regular cell of its kind (all edges equal) and volume.
Real edge(const Mesh& mesh, Index c);

/// Collective. From the centre of every face of the patches `walls` (none given: of every patch but
/// the mirrors) a line goes along the inward normal until it leaves the mesh. The faces of the
/// patches `mirrors`, the planes of symmetry, reflect it. It counts where it leaves through a
/// face of one of them whose normal is within 45 degrees of it: so corners do not count. Its cells
/// are
///   sum over the cells it crosses of (length within the cell) / (size of the cell).
/// The size of a triangle or tetrahedron is its edge, as above, in all directions. That of any
/// other cell is its extent along the line, from the first to the last corner, so that thin layers
/// count as layers. A block of n bricks from wall to wall has n cells. The result is the line with
/// the fewest cells. Lines of more than a thousand cells do not count. Errors: Error{input} for an
/// unknown patch.
Gap narrowest_gap(const Mesh& mesh, const std::vector<std::string>& walls = {},
                  const std::vector<std::string>& mirrors = {});

}  // namespace fsi
