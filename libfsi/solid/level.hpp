#pragma once
// The part of a stress that a jump of the pressure bears at the solid's surface.

#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/gradient.hpp"

namespace fsi::solid {

/// The gradient of a pressure that rises by J_f over the faces f of a band, from P outward:
/// that of the library (operators/gradient.hpp), with J in place of the differences,
///
///   l_c = sum_f g_cf J_f outward,
///   L_c = (1/V) sum_f (lambda_cf J_f + (l)_f . skew) S outward
///
/// where the mesh is skewed, else L = l. A pressure with these rises leaves no force beside it in
/// any cell of any mesh, and the force is conservative.
class Level {
 public:
  explicit Level(const Mesh& mesh) : mesh_(mesh), first_(mesh), whole_(mesh) {}

  /// No rises.
  void clear();
  /// On a boundary face J counts where the pressure is given.
  void add(Index f, Real J, const FaceWeights& weights, const GradientStencil& stencil);
  /// Collective. force_c += L_c and balance_f -= (L)_f . d on the band's cells and internal faces:
  /// the cells' share of the rises, which are to be in balance. force: owned.
  void apply(CellField<Vec3>& force, FaceField<Real>& balance, const FaceWeights& weights,
             const GradientStencil& stencil, const Band& band);

 private:
  const Mesh& mesh_;
  CellField<Vec3> first_, whole_;  // l and, on skewed meshes, L
  std::vector<Index> faces_;       // with a rise
  std::vector<Index> cells_;       // of the last band, on skewed meshes
};

}  // namespace fsi::solid
