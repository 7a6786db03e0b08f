#pragma once
// A body force on the solid alone, in a form that a pressure can balance.

#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/solid/balanced_jump_force.hpp"

namespace fsi::solid {

/// Force alpha a per volume. At the surface the force jumps, and so does the gradient of the
/// pressure that balances it. If the force were summed cell by cell, a part would stay unbalanced
/// there.
class BodyForce {
 public:
  /// a: force per volume of solid.
  BodyForce(const Mesh& mesh, const FaceWeights& weights, const Vec3& a)
      : mesh_(mesh), a_(a), jump_force_(mesh, weights) {}

  /// Collective. The rise of the pressure over a face that balances the force is F_f = alpha_f a .
  /// d:
  ///   force_c += calL_c, the gradient of a pressure with the rises F_f (BalancedJumpForce)
  ///   c_f     += F_f - (calL)_f . d, its counterpart in the face flux (`rhie_chow_source`)
  /// If p_N - p_P = F_f on every face, neither cells nor fluxes are accelerated. alpha_f: on the
  /// band's faces. force: owned and halo.
  void apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
             const FaceField<Real>& alpha_f, PressureStencil& pressure, const Band& band);

 private:
  const Mesh& mesh_;
  Vec3 a_;
  BalancedJumpForce jump_force_;
};

}  // namespace fsi::solid
