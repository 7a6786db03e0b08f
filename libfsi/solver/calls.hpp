#pragma once
// The calls of a step, by which its wall time is counted.

#include "libfsi/core/profile.hpp"

namespace fsi {

/// Numbers of the calls in a profile. Each is added with its name and the phase it belongs to.
struct Calls {
  Profile& profile;  ///< that they are added to
  ///@{
  /// Call of that name in doc/theory/step.md.
  int hold_shape = profile.add("hold_shape", "vof");
  int advance_interface = profile.add("advance_interface", "vof");
  int separate_bodies = profile.add("separate_bodies", "vof");
  int advect_pressure_jump = profile.add("advect_pressure_jump", "solid");
  int set_pressure_gradient = profile.add("set_pressure_gradient", "momentum");
  int set_velocity_gradient = profile.add("set_velocity_gradient", "momentum");
  int transport_memory = profile.add("transport_memory", "solid");
  int transport_elastic = profile.add("transport_elastic", "solid");
  int mix_viscosity = profile.add("mix_viscosity", "solid");
  int mix_density = profile.add("mix_density", "solid");
  int add_elastic_force = profile.add("add_elastic_force", "solid");
  int add_semi_implicit = profile.add("add_semi_implicit", "solid");
  int add_body_force = profile.add("add_body_force", "momentum");
  int balance_weight = profile.add("balance_weight", "pressure");
  int set_flux_excess = profile.add("set_flux_excess", "flux");
  int predict_momentum = profile.add("predict_momentum", "momentum");
  int predict_flux = profile.add("predict_flux", "flux");
  int project = profile.add("project", "pressure");
  int hold_mean_velocity = profile.add("hold_mean_velocity", "flux");
  int check = profile.add("check", "flux");
  ///@}
};

}  // namespace fsi
