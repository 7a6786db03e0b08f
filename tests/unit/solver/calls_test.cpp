// What -log_view and summary.json tell of a step.

#include <gtest/gtest.h>
#include <petscsys.h>

#include <set>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi {
namespace {

TEST(Calls, EveryOneOfAStepHasALogEvent) {
  const Mesh mesh = test::box_mesh({.n = {8, 8, 0}, .periodic = {true, true, false}});
  Solver solver(mesh, {}, {});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (const std::string name :
       {"advance_interface", "separate_bodies", "advect_pressure_jump", "set_pressure_gradient",
        "set_velocity_gradient", "transport_elastic", "mix_viscosity", "mix_density",
        "add_elastic_force", "add_semi_implicit", "add_body_force", "balance_weight",
        "set_flux_excess", "predict_momentum", "predict_flux", "project", "hold_mean_velocity",
        "check"}) {
    PetscLogEvent event = -1;
    FSI_PETSC(PetscLogEventGetId(("fsi " + name).c_str(), &event));
    EXPECT_GE(event, 0) << name;
  }
  solver.step(0.1);
  std::set<std::string> phases;
  for (const auto& [phase, seconds] : solver.profile().seconds()) phases.insert(phase);
  EXPECT_EQ(phases, (std::set<std::string>{"vof", "solid", "momentum", "flux", "pressure"}));
  EXPECT_GT(solver.profile().seconds().at("pressure"), 0);
}

}  // namespace
}  // namespace fsi
