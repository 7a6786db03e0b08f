#pragma once
// A reference map carried outward from the solid into the fluid.

#include <utility>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/rings.hpp"

namespace fsi::solid {

/// Continues a vector d linearly into three rings of cells around those that know it, as a map's
/// gradient must go on unchanged there ([Kamrin12], [Rycroft20]: regression from cells already
/// set). With r_k = x_k - x_c and w_k = 1 / |r_k|^2 over the vertex neighbours k
///   known cells     g = arg min sum w_k |d_c + g . r_k - d_k|^2 over known k
///   rings 1 to 3    (d_c, g) = arg min sum w_k (|d_c + g . r_k - d_k|^2 + |r_k|^2 |g - g_k|^2)
///                   over the k that are known or of an inner ring
/// The second term carries the gradient where neighbours on one side alone do not give it. Exact
/// for linear d on any mesh, periods included: d has none of its own. Beyond a plane of symmetry
/// lie the images of the cells, with R d_k and R g_k R (symmetry_faces.hpp).
class MapExtension {
 public:
  /// symmetry: faces beyond which the images of the cells count as neighbours. mesh must outlive
  /// it.
  MapExtension(const Mesh& mesh, SymmetryFaces symmetry)
      : mesh_(mesh), symmetry_(std::move(symmetry)), item_(mesh), rings_(mesh) {}

  /// Collective. d: owned cells known on entry; on return owned and halo set on known cells and
  /// rings, zero beyond. is_set: 1 where d is set, else 0; owned and halo.
  void apply(CellField<Vec3>& d, CellField<Real>& is_set, const Band& known);

  const SymmetryFaces& symmetry() const { return symmetry_; }  ///< as given
  /// The cells that the last call set.
  const Rings& rings() const { return rings_; }
  /// Gradient g of the fit in a cell that the last call set.
  const Tensor& slope(Index c) const { return item_[c].g; }
  /// Gradient by the regression of known cells over all vertex neighbours that are set.
  Tensor regression(Index c) const { return regression(c, Rings::count); }

 private:
  struct Item {  ///< the value and its gradient
    Vec3 d;
    Tensor g;
  };
  Tensor regression(Index c, int up_to_ring) const;
  Item fit(Index c, int ring) const;

  const Mesh& mesh_;
  SymmetryFaces symmetry_;
  CellField<Item> item_;
  Rings rings_;
};

}  // namespace fsi::solid
