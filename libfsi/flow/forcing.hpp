#pragma once
// The uniform force S that holds the mean velocity of a periodic channel.

#include "libfsi/field/field.hpp"
#include "libfsi/flow/projection.hpp"

namespace fsi::flow {

/// Collective. Volume mean of the velocity along a unit vector `axis`, from the flux:
///   (1/V) sum_f phi_f d_f . axis,   sum over all faces of the mesh; exact where div u = 0.
Real mean_velocity(const FaceField<Real>& phi, const Vec3& axis, const Mesh& mesh);

/// Holds the mean velocity U_0 along `axis`. The flux phi_1 of a projected uniform force is
/// divergence-free, so a multiple of it keeps div u = 0:
///   eta = (U_0 - mean(phi)) / mean(phi_1),   phi += eta phi_1,   u += eta u_1,
///   S += (rho / dt + kappa_w) eta,   p += (rho / dt + kappa_w) eta q_1,
/// q_1 the potential of the projection of the force.
/// The mean is that of `mean_velocity`. For a divergence-free flux it is the same through every
/// section, so a particle that crosses the period changes nothing.
class Forcing {
 public:
  /// Collective. Projects a uniform force along the axis once.
  Forcing(const Mesh& mesh, Projection& projection, const Vec3& axis, Real mean_velocity);

  /// Collective. Sets phi_1 and u_1 anew for a density: a uniform force accelerates a solid by less
  /// or more than the fluid.
  void renew(Projection& projection, const Density& density);

  /// On return the mean is the target to round-off. Changes u (owned and halo), phi and `gradient`.
  /// friction: kappa_w (bulk_friction.hpp). Returns the change of `gradient`.
  Real hold(CellField<Vec3>& u, FaceField<Real>& phi, Real rho, Real friction, Real dt);

  /// Adds the pressure that belongs to a change of `gradient`; owned and halo.
  void add_pressure(CellField<Real>& p, Real change) const;

  /// S: force per volume along the axis, the driving pressure gradient. Part of a checkpoint.
  Real gradient = 0;

 private:
  Real mean(const FaceField<Real>& phi) const { return mean_velocity(phi, axis_, mesh_); }
  const Mesh& mesh_;
  Vec3 axis_;
  Real target_;
  CellField<Vec3> u_1_;
  FaceField<Real> phi_1_;
  Real mean_1_ = 1;
  CellField<Real> potential_;
  BoundaryField<Real> potential_b_;
};

}  // namespace fsi::flow
