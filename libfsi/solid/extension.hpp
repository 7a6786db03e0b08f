#pragma once
// Values of the solid's interior carried outward into the fluid.

#include <cstdint>
#include <span>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// Cells from this fraction of solid on know their own deformation.
inline constexpr Real alpha_known = 0.5;

/// Continues a tensor known inside the solid into the cells around it:
///
///   known        alpha >= 1/2: T as it is
///   not known    T = sum w T_k / sum w, w = 1 / |d|^2, over the vertex neighbours that are set
///                already, ring by ring to three rings beyond the known cells; zero beyond
class Extension {
 public:
  explicit Extension(const Mesh& mesh);

  /// Collective. Finds the inner ones among the cells of `known`, the band of alpha >= alpha_known:
  /// those whose face neighbours are all known; and `near`.
  void mark(const CellField<Real>& alpha, const Band& known);
  /// Collective. T: owned and halo, before and after.
  void apply(CellField<SymTensor>& T, const Band& known);

  /// Whether cell c is an inner one; owned and halo.
  bool inner(Index c) const { return zone_[c] > 1; }
  /// Not zero in the cells of `known` and those around, and where the last call of `apply` left a
  /// value; owned and halo.
  const CellField<Real>& near() const { return zone_; }
  /// Owned cells that the last call of `apply` set or found known, but for the last ring.
  std::span<const Index> inside() const { return std::span(set_).first(inside_); }
  /// Owned cells of the last ring.
  std::span<const Index> last_ring() const { return std::span(set_).subspan(inside_); }

 private:
  void list_ring(Real ring, const Band& known);
  void fill(CellField<SymTensor>& T, Real ring);

  const Mesh& mesh_;
  CellField<Real> zone_;     // 1: near, 2: inner
  CellField<Real> ring_of_;  // 1: known, 2 to 4: set by a ring; 0: not set
  std::vector<Index> set_, last_set_, ring_, near_;
  std::vector<SymTensor> values_;
  std::size_t inside_ = 0;
  std::vector<std::int32_t> stamp_;
  std::int32_t calls_ = 0;
};

}  // namespace fsi::solid
