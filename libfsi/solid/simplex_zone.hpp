#pragma once
// The simplex zone: the cells that follow the rules of triangles and tetrahedra.

#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// All triangles, all tetrahedra and every cell that shares a vertex with one. A triangle is not
/// symmetric about its centre, and the quasi-Green gradients of all these cells have an error of a
/// part of h grad grad u (InterfaceGradient). In a mesh with several types of cells, each cell so
/// follows the rules of its own type.
class SimplexZone {
 public:
  /// Collective.
  explicit SimplexZone(const Mesh& mesh);

  bool any() const { return any_; }  ///< whether some rank has a cell of the zone
  bool all() const { return all_; }  ///< whether all cells of all ranks are in the zone
  /// Whether cell c, owned or halo, is in the zone.
  bool has(Index c) const { return within_[c] > 0; }
  /// Whether cell c is in the zone or shares a vertex with a cell of it.
  bool near(Index c) const { return near_[c] > 0; }
  /// 1 in these cells, else 0; owned and halo.
  const CellField<Real>& cells() const { return within_; }

 private:
  CellField<Real> within_, near_;
  bool any_ = false, all_ = false;
};

}  // namespace fsi::solid
