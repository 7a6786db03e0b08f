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

/// Continues a tensor known inside the solid into the cells around it, and lets it relax to that
/// continuation in the outermost cells of the solid, where the velocity gradient has a kink that
/// the mesh does not resolve.
///
///   known    alpha >= 1/2
///   inner    known, as are all face neighbours; known cells of thin parts, which have no inner
///            cell around them, count as inner
///   T_ext    = sum w T_k / sum w, w = 1 / |d|^2, over vertex neighbours that are set already: the
///            inner cells first, then layer by layer to three layers beyond the known cells
///   known but not inner    T <- T_ext + exp(-2 Co) (T - T_ext), Co = |u - u_s| dt / h,
///            u_s the mean velocity of the solid
///   not known              T <- T_ext; zero beyond the last layer
///
/// An interface cell forgets its own value while the solid beside it moves by half a cell relative
/// to the whole, and keeps it in a solid that rests or moves as one. How little the factor matters:
/// doc/verification/disc.md.
class Extension {
 public:
  explicit Extension(const Mesh& mesh);

  /// Collective. Sorts the cells of `known`, the band of alpha >= alpha_known, into inner and
  /// outer ones.
  void mark(const CellField<Real>& alpha, const Band& known);
  /// Collective, after `mark` with the same alpha and known. T: owned and halo, before and after.
  /// u: owned. dt = 0 does not relax.
  void apply(CellField<SymTensor>& T, const CellField<Real>& alpha, const Band& known,
             const CellField<Vec3>& u, Real dt);

  /// Owned cells that the last call set, but for the last layer.
  std::span<const Index> inside() const { return std::span(set_).first(inside_); }
  /// Whether cell c is an inner one, thin parts not counted; owned and halo.
  bool inner(Index c) const { return inner_[c] > 0; }
  /// Owned cells of the last layer.
  std::span<const Index> last_layer() const { return std::span(set_).subspan(inside_); }

 private:
  static constexpr Real inner_layer = 1, thin_layer = 1.5, outer_layer = 2;
  void sort(const Band& known);
  void list_ring(Real layer, const Band& known);
  void fill(CellField<SymTensor>& T, Real layer);
  void relax(CellField<SymTensor>& T, const CellField<Vec3>& u, const Vec3& u_s, Real dt) const;
  Vec3 mean(const CellField<Vec3>& u, const CellField<Real>& alpha, const Band& known) const;

  const Mesh& mesh_;
  std::vector<Real> h_;       // [n_owned] V / max |Sf|
  CellField<Real> inner_;     // 1: inner
  CellField<Real> layer_of_;  // that set a cell's T; 0: not set
  std::vector<Index> set_, last_set_, outer_, layer_;
  std::vector<SymTensor> values_, own_;  // own_: of the cells in outer_, before
  std::size_t inside_ = 0;
  std::vector<std::int32_t> stamp_;
  std::int32_t calls_ = 0;
};

}  // namespace fsi::solid
