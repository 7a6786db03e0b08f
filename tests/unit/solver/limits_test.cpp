// What sets the length of a step.

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/run/case.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi {
namespace {

/// A uniform flow of velocity 1 through 8 x 8 cells of a periodic square.
struct Uniform {
  Uniform() : solver(mesh, {}, {}) {
    solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });
  }
  const Mesh mesh = test::box_mesh({.n = {8, 8, 0}, .periodic = {true, true, false}});
  Solver solver;
};

TEST(StableStep, AdvectiveUnlessFixed) {
  Uniform flow;
  const Limit limit = stable_dt(flow.solver, {.end = 1000, .courant = 0.4});
  EXPECT_NEAR(limit.dt, 0.4 / 8, 1e-12);
  EXPECT_EQ(limit.name, "advective");
  const Limit fixed = stable_dt(flow.solver, {.end = 1000, .courant = 0.4, .step = 0.3});
  EXPECT_EQ(fixed.dt, 0.3);
  EXPECT_EQ(fixed.name, "fixed");
  EXPECT_EQ(stable_dt(flow.solver, {.end = 1000, .step_max = 1e-3}).name, "step_max");
}

TEST(StableStep, GrowsByATenthFromTheFirst) {
  Uniform flow;
  const TimeSetup time{.end = 1000, .step_first = 1e-3};
  for (int i = 0; i < 5; ++i) {
    const Limit limit = stable_dt(flow.solver, time);
    EXPECT_NEAR(limit.dt, 1e-3 * std::pow(1.1, i), 1e-15);
    EXPECT_EQ(limit.name, "start");
    flow.solver.advance(limit.dt);
  }
}

}  // namespace
}  // namespace fsi
