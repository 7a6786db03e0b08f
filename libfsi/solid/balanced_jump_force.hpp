#pragma once
// The part of the elastic stress that a jump of the pressure balances at the solid's surface.

#include <optional>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/vertex_mean.hpp"

namespace fsi::solid {

/// The gradient calL of a pressure that rises by [p]_f over the faces f of a band, from P outward.
/// It is the library's gradient of p (operators/gradient.hpp) with [p]_f in place of the
/// differences:
///
///   Pi_c   = sum_f g_cf [p]_f,
///   calL_c = (1/V) sum_f (lambda_cf [p]_f + (Pi)_f . skew) S,   both sums outward.
///
/// A pressure with these rises balances this force exactly, in every cell of any mesh. The force is
/// conservative. In the code [p]_f is `J`, Pi is `first_` and calL is `whole_`.
class BalancedJumpForce {
 public:
  /// mesh and weights must outlive it.
  BalancedJumpForce(const Mesh& mesh, const FaceWeights& weights);

  /// Sets all rises to zero.
  void clear();
  /// Adds the rise J over face f. On a boundary face it counts where the pressure is given.
  void add(Index f, Real J, const GradientStencil& stencil);
  /// Collective. Adds the force and its counterpart c_f (`rhie_chow_source`),
  ///   force_c += calL_c,   c_f -= ((calL)_f . S - (Pi)_f . k) / g,
  /// with the means of the face flux. Works on the band's cells and internal faces. On an irregular
  /// mesh it also works on those that share a vertex with them. force: owned.
  void apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, PressureStencil& pressure,
             const Band& of_rises);

 private:
  void add_irregular(const GradientStencil& stencil, const Band& band);

  const Mesh& mesh_;
  CellField<Vec3> first_, whole_;  // Pi and calL
  std::vector<Vec3> at_faces_;     // Pi at irregular faces
  std::vector<Index> faces_;       // with a rise
  std::vector<Index> reached_;  // faces of the last band, next to which Pi and calL may not be zero
  std::optional<Band> around_;  // the band and its vertex neighbours, on irregular meshes
};

}  // namespace fsi::solid
