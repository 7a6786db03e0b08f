#include "libfsi/flow/forcing.hpp"

#include "libfsi/core/parallel.hpp"

namespace fsi::flow {

Real mean_velocity(const FaceField<Real>& phi, const Vec3& axis, const Mesh& mesh) {
  Sum sum;  // every face once: by the rank of its owner
  for (Index f = 0; f < mesh.n_faces; ++f)
    if (mesh.owner[f] < mesh.n_owned) sum.add(phi[f] * dot(mesh.d[f], axis));
  return sum.total() / mesh.total_volume;
}

Forcing::Forcing(const Mesh& mesh, Projection& projection, const Vec3& axis, Real mean_velocity)
    : mesh_(mesh),
      axis_(axis / norm(axis)),
      target_(mean_velocity),
      u_1_(mesh),
      phi_1_(mesh),
      potential_(mesh),
      potential_b_(mesh) {
  for (Index f = 0; f < mesh.n_internal; ++f) phi_1_[f] = dot(axis_, mesh.Sf[f]);
  // Rounding is enough in a straight channel, where the uniform field is the solution itself.
  constexpr Real round_off = 1e-13;
  projection.project(phi_1_, potential_, u_1_, potential_b_, round_off * size(phi_1_, mesh));
  for (Index c = 0; c < mesh.n_cells; ++c) u_1_[c] = axis_ - u_1_[c];
  mean_1_ = mean(phi_1_);
}

// phi_1 = rho_0 / rho_f (axis . S), projected;   u_1 = rho_0 axis / rhohat - rho_0 grad q / rhohat
void Forcing::renew(Projection& projection, const Density& density) {
  phi_1_.fill(0);
  for (Index f = 0; f < mesh_.n_internal; ++f)
    phi_1_[f] = density.rho_0() / density.of_face()[f] * dot(axis_, mesh_.Sf[f]);
  constexpr Real relative = 1e-10;
  projection.project(phi_1_, potential_, u_1_, potential_b_, relative * size(phi_1_, mesh_));
  for (Index c = 0; c < mesh_.n_cells; ++c)
    u_1_[c] = density.rho_0() * density.divided(axis_, c) - u_1_[c];
  mean_1_ = mean(phi_1_);
}

Real Forcing::hold(CellField<Vec3>& u, FaceField<Real>& phi, Real rho, Real friction, Real dt) {
  const Real c = (target_ - mean(phi)) / mean_1_;
  for (Index i = 0; i < mesh_.n_cells; ++i) u[i] += c * u_1_[i];
  for (Index f = 0; f < mesh_.n_internal; ++f) phi[f] += c * phi_1_[f];
  const Real change = (rho / dt + friction) * c;
  gradient += change;
  return change;
}

void Forcing::add_pressure(CellField<Real>& p, Real change) const {
  for (Index c = 0; c < mesh_.n_cells; ++c) p[c] += change * potential_[c];
}

}  // namespace fsi::flow
