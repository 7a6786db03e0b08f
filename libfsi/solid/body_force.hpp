#pragma once
// A body force on the solid alone, in the form in which a pressure can balance it.

#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/solid/balanced_jump_force.hpp"

namespace fsi::solid {

/// Force alpha a per volume. Through its surface it jumps, and the pressure's gradient with it; a
/// force taken cell by cell leaves there what no pressure balances.
class BodyForce {
 public:
  /// a: acceleration of the solid.
  BodyForce(const Mesh& mesh, const FaceWeights& weights, const Vec3& a)
      : mesh_(mesh), a_(a), jump_force_(mesh, weights) {}

  /// Collective. With F_f = alpha_f a . d, the pressure's rise over a face that balances it:
  ///   force_c   += f_c, the gradient of that pressure (BalancedJumpForce)
  ///   balance_f += F_f - (f)_f . d, its counterpart in the face flux
  /// Where p_N - p_P = F_f on every face, neither cells nor faces are accelerated. alpha_f: on the
  /// band's faces. force: owned and halo.
  void apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
             const FaceField<Real>& alpha_f, PressureStencil& pressure, const Band& band);

 private:
  const Mesh& mesh_;
  Vec3 a_;
  BalancedJumpForce jump_force_;
};

}  // namespace fsi::solid
