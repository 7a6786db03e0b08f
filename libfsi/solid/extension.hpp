#pragma once
// Extrapolation of a tensor from the known cells of the solid into the fluid around it.

#include <span>
#include <utility>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/rings.hpp"

namespace fsi::solid {

/// A cell with at least this fraction of solid is a known cell, if a face neighbour has it too.
inline constexpr Real alpha_known = 0.5;

/// Extrapolates a tensor from the known cells into three rings of vertex neighbours, one ring after
/// the other. The sums run over the vertex neighbours k that are known or in a ring before. The
/// vector r_k leads to k, and w_k = 1 / |r_k|^2:
///
///   linear     T_c = sum_k w_k (T_k - Gamma_k . r_k) / sum_k w_k,
///              Gamma_c = sum_k w_k Gamma_k / sum_k w_k
///   constant   T_c = sum_k w_k T_k / sum_k w_k
///
/// In a known cell Gamma is the slope of T by a least-squares fit over its known vertex neighbours
/// and their images beyond planes of symmetry. To extrapolate no noise from cell to cell, Gamma is
/// multiplied by (Gamma : Gammabar) / (Gamma : Gamma), limited to 0 to 1. Gammabar is the mean of
/// the fitted slopes over those vertex neighbours that are inner cells and have no face on the
/// boundary but on these planes. Without such neighbours, as in a thin solid, Gamma = 0 and the
/// extrapolation is constant. In a thicker solid it is exact for a linear T.
///
/// A cell of alpha >= 1/2 without such a face neighbour is not known: nothing would limit its
/// strain.
class Extension {
 public:
  /// symmetry: planes beyond which the images R T R of known cells count as neighbours. mesh must
  /// outlive it.
  explicit Extension(const Mesh& mesh, SymmetryFaces symmetry = {})
      : mesh_(mesh), symmetry_(std::move(symmetry)), zone_(mesh), rings_(mesh) {}

  /// Collective. Lists the rings around `known`, the band of alpha >= alpha_known. Finds the inner
  /// cells: known cells whose face neighbours all have alpha >= alpha_known.
  void mark(const CellField<Real>& alpha, const Band& known);
  /// Collective. Linear. T: set in owned known cells before; after, set in the rings and the halo
  /// as well. T is set to zero where only an earlier call had set it. slope: scratch, zero in owned
  /// cells after.
  void linear(CellField<SymTensor>& T, CellField<SymGradient>& slope);
  /// Collective. Reduces the fourth differences of T in a time dt [Jameson81],
  ///   T += gamma sum_k w_k (T_k - T - (Gamma + Gamma_k) / 2 . r_k) / sum_k w_k,
  /// over the known vertex neighbours k and their images. gamma is `alternating_part`, Gamma the
  /// slope by least squares. A linear T does not change. Works in the known cells where `where` is
  /// not zero. T: of owned known cells; slope: as above; speed: c_s; recovery: G / mu_s.
  void fourth_difference_filter(CellField<SymTensor>& T, CellField<SymGradient>& slope,
                                const CellField<Real>& where, Real speed, Real recovery, Real dt);
  /// Collective. Constant, in the cells of the rings where `where` is not zero; no other cell is
  /// changed. T: set in owned known cells before; where: not zero there, owned and halo.
  void constant(CellField<SymTensor>& T, const CellField<Real>& where);

  const SymmetryFaces& symmetry() const { return symmetry_; }  ///< as given
  /// Whether cell c is an inner one; owned and halo.
  bool inner(Index c) const { return zone_[c] > 1; }
  /// Not zero in known cells and rings of the last two calls of `mark`; owned and halo.
  const CellField<Real>& near() const { return zone_; }
  /// Owned known cells, then those of all rings but the last.
  std::span<const Index> inside() const { return rings_.inside(); }
  /// Owned cells of the last ring.
  std::span<const Index> last_ring() const { return rings_.last_ring(); }

 private:
  void set_slopes(CellField<SymGradient>& slope, const CellField<SymTensor>& T);
  SymGradient least_squares(const CellField<SymTensor>& T, Index c) const;
  SymGradient limited_slope(const CellField<SymGradient>& slope, Index c) const;

  const Mesh& mesh_;
  SymmetryFaces symmetry_;
  CellField<Real> zone_;  // 1: near, 2: inner, 3: inner, and no boundary face but of symmetry
  Rings rings_;
  std::vector<Index> known_, alone_, near_;  // alone_: alpha >= 1/2, but no known cell
  std::vector<SymGradient> slopes_;
  std::vector<SymTensor> change_;
};

}  // namespace fsi::solid
