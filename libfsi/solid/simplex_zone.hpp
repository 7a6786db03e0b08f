#pragma once
// The cells that follow the rules of triangles and tetrahedra.

#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// Triangles and tetrahedra and all cells that share a vertex with one. A triangle is not symmetric
/// about its centre, and the gradients of all these cells are off by a part of h grad grad u
/// (InterfaceGradient). In a mesh of several kinds of cells each cell so has the rules of its own
/// kind.
class SimplexZone {
 public:
  /// Collective.
  explicit SimplexZone(const Mesh& mesh);

  bool any() const { return any_; }  ///< whether some rank has such a cell
  bool all() const { return all_; }  ///< whether all ranks have only such cells
  /// Whether cell c, owned or of the halo, is one.
  bool has(Index c) const { return within_[c] > 0; }
  /// Whether it is one or shares a vertex with one.
  bool near(Index c) const { return near_[c] > 0; }
  /// 1 in these cells, else 0; owned and halo.
  const CellField<Real>& cells() const { return within_; }

 private:
  CellField<Real> within_, near_;
  bool any_ = false, all_ = false;
};

}  // namespace fsi::solid
