#pragma once
// The part of a stress that a jump of the pressure bears at the solid's surface.

#include <optional>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/vertex_mean.hpp"

namespace fsi::solid {

/// The gradient of a pressure that rises by J_f over the faces f of a band, from P outward:
/// that of the library (operators/gradient.hpp), with J in place of the differences,
///
///   l_c = sum_f g_cf J_f outward,
///   L_c = (1/V) sum_f (lambda_cf J_f + (l)_f . skew) S outward.
///
/// A pressure with these rises leaves no force beside it in any cell of any mesh, and the force is
/// conservative.
class BalancedJumpForce {
 public:
  /// mesh and weights must outlive it.
  BalancedJumpForce(const Mesh& mesh, const FaceWeights& weights);

  /// No rises.
  void clear();
  /// On a boundary face J counts where the pressure is given.
  void add(Index f, Real J, const GradientStencil& stencil);
  /// Collective. force_c += L_c and balance_f -= ((L)_f . S - (l)_f . k) / g, with the means of the
  /// face flux: the cells' share of the rises, which are to be in balance. On the band's cells and
  /// internal faces, where the mesh is irregular on those that share a vertex with them too. force:
  /// owned.
  void apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, PressureStencil& pressure,
             const Band& of_rises);

 private:
  void add_irregular(const GradientStencil& stencil, const Band& band);

  const Mesh& mesh_;
  CellField<Vec3> first_, whole_;  // l and L
  std::vector<Vec3> at_faces_;     // l at irregular faces
  std::vector<Index> faces_;       // with a rise
  std::vector<Index> reached_;     // faces of the last band, whose cells may have a part
  std::optional<Band> around_;     // the band with these, on irregular meshes
};

}  // namespace fsi::solid
