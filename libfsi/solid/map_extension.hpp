#pragma once
// A reference map carried outward from the solid into the fluid.

#include <cstdint>
#include <span>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// Continues a vector d linearly into three rings of cells around those that know it, as a map's
/// gradient must go on unchanged there ([Kamrin12], [Rycroft20]: regression from cells already
/// set). With r_k = x_k - x_c and w_k = 1 / |r_k|^2 over the vertex neighbours k
///   known cells     g = arg min sum w_k |d_c + g . r_k - d_k|^2 over known k
///   rings 1 to 3    (d_c, g) = arg min sum w_k (|d_c + g . r_k - d_k|^2 + |r_k|^2 |g - g_k|^2)
///                   over the k that are known or of an inner ring
/// The second term carries the gradient where neighbours on one side alone do not give it. Exact
/// for linear d on any mesh, periods included: d has none of its own.
class MapExtension {
 public:
  explicit MapExtension(const Mesh& mesh);

  /// Collective. d: owned cells known on entry; on return owned and halo set on known cells and
  /// rings, zero beyond. is_set: 1 where d is set, else 0; owned and halo.
  void apply(CellField<Vec3>& d, CellField<Real>& is_set, const Band& known);

  /// Owned cells that the last call set, but for the last ring.
  std::span<const Index> inside() const { return std::span(set_).first(inside_); }
  /// Owned cells of the last ring.
  std::span<const Index> last_ring() const { return std::span(set_).subspan(inside_); }
  /// Gradient g of the fit in a cell that the last call set.
  const Tensor& slope(Index c) const { return item_[c].g; }
  /// Gradient by the regression of known cells over all vertex neighbours that are set.
  Tensor regression(Index c) const { return regression(c, last_layer); }

 private:
  struct Item {  ///< the value, its gradient, and the layer that set it; 0: not set
    Vec3 d;
    Tensor g;
    Real layer = 0;
  };
  static constexpr Real known_layer = 1, last_layer = 4;
  Tensor regression(Index c, Real up_to) const;
  Item fit(Index c, Real layer) const;
  void list_ring(Real layer, const Band& known);

  const Mesh& mesh_;
  CellField<Item> item_;
  std::vector<Index> set_, last_set_, ring_;
  std::vector<Item> fitted_;
  std::size_t inside_ = 0;
  std::vector<std::int32_t> stamp_;
  std::int32_t calls_ = 0;
};

}  // namespace fsi::solid
