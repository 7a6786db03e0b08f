#pragma once
// Values of the solid's interior carried outward into the fluid.

#include <span>
#include <utility>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/rings.hpp"

namespace fsi::solid {

/// Cells from this fraction of solid on know their own deformation.
inline constexpr Real alpha_known = 0.5;

/// Continues a tensor known inside the solid (alpha >= 1/2) into three rings of cells around it,
/// ring by ring, from the vertex neighbours k that are set already, w = 1 / |r|^2, r from k:
///
///   linear     T = sum w (T_k + g_k . r) / sum w,   g = sum w g_k / sum w
///   constant   T = sum w T_k / sum w
///
/// g of a known cell is that of least squares over its known vertex neighbours and their images
/// beyond a plane of symmetry. It counts as far as
/// the mean m over the surrounded ones among them bears it out, by (g : m) / (g : g) within [0, 1].
/// A cell with no known one behind any of its faces counts as not known: the strain of such a speck
/// is told by nothing and would grow without bound. Surrounded: the face neighbours are all known
/// and no face is of the boundary. Exact for a linear T but where the solid is thin, which goes on
/// as a constant; what alternates from cell to cell is not extrapolated.
class Extension {
 public:
  /// symmetry: where known cells go on as their images, R T R. mesh must outlive it.
  explicit Extension(const Mesh& mesh, SymmetryFaces symmetry = {})
      : mesh_(mesh), symmetry_(std::move(symmetry)), zone_(mesh), rings_(mesh) {}

  /// Collective. Lists the rings around `known`, the band of alpha >= alpha_known, and finds its
  /// inner cells: those whose face neighbours are all known.
  void mark(const CellField<Real>& alpha, const Band& known);
  /// Collective. Linear. T: set on owned known cells before, in the rings and the halo too after,
  /// zero where only an earlier call had set it. slope: scratch, zero in owned cells after.
  void linear(CellField<SymTensor>& T, CellField<SymGradient>& slope);
  /// Collective. Damps what alternates from known cell to known cell in a time dt,
  ///   T += alternating_part sum w (T_k - T - (g + g_k) / 2 . (x_k - x)) / sum w
  /// over the known vertex neighbours k and their images, g the least squares. These are fourth
  /// differences [Jameson81], nothing of a linear T. Works in the cells where `where` is not zero.
  /// T: of owned known cells; slope: as above; speed, recovery: of a wave of the cells' length,
  /// where viscosity does not matter and where it rules.
  void fourth_difference_filter(CellField<SymTensor>& T, CellField<SymGradient>& slope,
                                const CellField<Real>& where, Real speed, Real recovery, Real dt);
  /// Collective. Constant, in the cells of the rings where `where` is not zero; no other cell is
  /// touched. T: set on owned known cells before; where: not zero there, owned and halo.
  void constant(CellField<SymTensor>& T, const CellField<Real>& where);

  const SymmetryFaces& symmetry() const { return symmetry_; }  ///< as given
  /// Whether cell c is an inner one; owned and halo.
  bool inner(Index c) const { return zone_[c] > 1; }
  /// Not zero in known cells and rings, those of the last two calls of `mark`; owned and halo.
  const CellField<Real>& near() const { return zone_; }
  /// Owned known cells, then those of the rings but for the last.
  std::span<const Index> inside() const { return rings_.inside(); }
  /// Owned cells of the last ring.
  std::span<const Index> last_ring() const { return rings_.last_ring(); }

 private:
  void set_slopes(CellField<SymGradient>& slope, const CellField<SymTensor>& T);
  SymGradient least_squares(const CellField<SymTensor>& T, Index c) const;
  SymGradient limited_slope(const CellField<SymGradient>& slope, Index c) const;

  const Mesh& mesh_;
  SymmetryFaces symmetry_;
  CellField<Real> zone_;  // 1: near, 2: inner, 3: and away from the boundary
  Rings rings_;
  std::vector<Index> known_, alone_, near_;  // alone_: in the band, but taken for unknown
  std::vector<SymGradient> slopes_;
  std::vector<SymTensor> change_;
};

}  // namespace fsi::solid
