#pragma once
// The reconstructed interface: one plane a cell.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/geometry/cut.hpp"

namespace fsi::vof {

/// Cells with epsilon < alpha < 1 - epsilon hold a plane.
inline constexpr Real epsilon = 1e-8;

/// Planes of the interface cells. Dense over the cells, so that a neighbour's plane is one look
/// away.
struct Interface {
  explicit Interface(const Mesh& mesh) : normal(mesh), centre(mesh) {}

  std::vector<Index> cells;  ///< owned interface cells, ascending
  CellField<Vec3>
      normal;  ///< unit, out of the solid (towards alpha = 0); zero where no plane. Halo set
  CellField<Vec3> centre;  ///< centroid of the plane in the cell, relative to C. Halo set
};

inline bool is_interface(Real alpha) { return alpha > epsilon && alpha < 1 - epsilon; }

/// Corners of owned cell c relative to C[c], ready to be cut.
void gather(geometry::Cell& cell, const Mesh& mesh, Index c);

/// Face f relative to C[c], as seen from c.
void gather(geometry::Polygon& face, const Mesh& mesh, Index f, Index c);

}  // namespace fsi::vof
