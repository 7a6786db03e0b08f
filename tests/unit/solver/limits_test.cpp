// What sets the length of a step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/run/case.hpp"
#include "libfsi/solver/energy.hpp"
#include "tests/unit/support/box_file.hpp"
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

// Explicit upwind convection bears half of the default Courant number: beyond it the corner under a
// fast lid would blow up.
TEST(StableStep, IsShorterWithUpwindConvection) {
  for (const auto scheme : {flow::Convection::linear_upwind, flow::Convection::limited})
    for (const bool simplex : {false, true}) {
      const Mesh mesh = test::read_box({.n = {16, 16, 0}, .simplex = simplex});
      Conditions walls;
      for (const char* name : {"left", "right", "bottom"}) walls[name] = Wall{};
      walls["top"] = Wall{Vec3{1, 0, 0}};
      Solver solver(mesh, {.rho = 1, .mu_f = 1e-3}, {.conditions = walls, .convection = scheme});
      solver.start([](const Vec3&) { return Vec3{}; });
      EnergyBalance energy(solver);
      for (int i = 0; i < 150; ++i)
        energy.add(solver, solver.advance(stable_dt(solver, {.end = 1000, .step_max = 0.1}).dt));
      EXPECT_LE(energy.part_made(), 0.02) << simplex;
      const Real courant = stable_dt(solver, {.end = 1000}).dt / solver.advective_dt(1);
      EXPECT_NEAR(courant, simplex ? 0.5 : 0.25, 1e-12);
    }
}

// A flow at rest allows any step, what stands at its openings does not.
TEST(StableStep, FollowsWhatIsGivenOverTime) {
  const Mesh mesh = test::box_mesh({.n = {8, 4, 0}});
  const auto limit_at_rest = [&](const OfTime& pressure) {
    Conditions conditions{{"bottom", Wall{}}, {"top", Wall{}}, {"right", Opening{}}};
    conditions["left"] = Opening{pressure};
    Solver solver(mesh, {}, {.conditions = conditions});
    solver.start([](const Vec3&) { return Vec3{}; });
    for (int i = 0; i < 10; ++i) solver.advance(1e-9);
    return stable_dt(solver, {.end = 40});
  };
  const Limit sine =
      limit_at_rest(OfTime([](Real t) { return 1e-9 * std::sin(2 * std::numbers::pi * t); }));
  EXPECT_EQ(sine.name, "conditions");
  EXPECT_LT(sine.dt, 1.0 / 60);
  EXPECT_GT(sine.dt, 1.0 / 90);
  const Limit constant = limit_at_rest(0);
  EXPECT_EQ(constant.name, "end");
  EXPECT_EQ(constant.dt, 2);
}

/// Slip channel, 8 x 4 cells of 1 x 1, between two pressures and in a force along it.
struct Channel {
  explicit Channel(Real pressure, Real force, const Vec3& u_0 = {})
      : solver(mesh, {.rho = 2},
               {.conditions = {{"bottom", Slip{}},
                               {"top", Slip{}},
                               {"left", Opening{pressure}},
                               {"right", Opening{}}},
                .body_force = [=](const Vec3&, Real) {
                  return Vec3{force, 0, 0};
                }}) {
    solver.start([=](const Vec3&) { return u_0; });
  }
  const Mesh mesh = test::read_box({.n = {8, 4, 0}});
  Solver solver;
};

// A flow at rest allows any step by its Courant number. A hundredth of a long run was too much.
TEST(StableStep, BeginsByTheAccelerationOfTheFluid) {
  constexpr Real a = 3, width = 1.0 / 8, courant = 0.5;
  const Real dt = std::sqrt(courant * width / (10 * a));
  for (const Real end : {20.0, 1e5})
    for (const Real part : {0.0, 0.3, 1.0}) {  // of the pressure
      Channel flow(2 * a * part, 2 * a * (1 - part));
      for (int i = 0; i < 10; ++i) {
        const Limit limit = stable_dt(flow.solver, {.end = end, .courant = courant});
        EXPECT_EQ(limit.name, "start");
        EXPECT_NEAR(limit.dt, dt, 1e-6 * dt);
        EXPECT_EQ(flow.solver.advance(limit.dt), limit.dt);
        EXPECT_NEAR(limit.dt / flow.solver.advective_dt(1), (i + 1) * courant / 10, 1e-4);
      }
      EXPECT_EQ(stable_dt(flow.solver, {.end = end, .courant = courant}).name, "advective");
    }
  // What the pressures balance, and what moves already, is not slowed.
  EXPECT_NEAR(stable_dt(Channel(-2 * a, 2 * a).solver, {.end = 20}).dt, 0.2, 1e-12);
  EXPECT_NEAR(stable_dt(Channel(0, 2 * a, {0.1, 0, 0}).solver, {.end = 20}).dt, 0.2, 1e-12);
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

// A layer of flat tetrahedra sets the step neither in the fluid nor in a solid, of which the flow
// may pass each cell but once in a step.
TEST(StableStep, IsNotThatOfTheFlatTetrahedraOfASolid) {
  const auto flat_layer = [](const Vec3& x) {
    return x.z > 0.4 && x.z < 0.6 ? Vec3{x.x, x.y, 1.0 / 3 + 0.03} : x;
  };
  const Mesh mesh = test::read_box({.n = {6, 6, 6},
                                    .simplex = true,
                                    .periodic = {"left", "right", "bottom", "top", "back", "front"},
                                    .moved = flat_layer});
  const Vec3 u{1, 0.3, 0.2};
  Solver solver(mesh, {}, {});
  solver.start([=](const Vec3&) { return u; });
  const Real empty = solver.advective_dt(0.5);
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.3), {0.5, 0.5, 0.4}), .G = 1e-3});
  EXPECT_EQ(solver.advective_dt(0.5), empty);
  Real rate = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Real sum = 0;
    for (const Index f : mesh.cell_faces[c]) sum += std::abs(dot(u, mesh.Sf[f]));
    if (solver.bodies()[0].alpha[c] > 0) rate = std::max(rate, sum / (2 * mesh.V[c]));
  }
  rate = global_max(rate);
  EXPECT_GT(empty, 0.55 / rate);
  EXPECT_NEAR(solver.carried_dt(), 1 / rate, 1e-9 / rate);
  // After a short step they would alternate if only the sum of two were limited.
  solver.step(0.1 / rate);
  EXPECT_NEAR(solver.carried_dt(), 1 / rate, 1e-3 / rate);
}

// The first steps of a solid that is put into a flow are short, too.
TEST(StableStep, BeginsAnewWithASolid) {
  Uniform flow;
  const TimeSetup time{.end = 1000, .step_first = 1e-3};
  for (int i = 0; i < 30; ++i) flow.solver.advance(stable_dt(flow.solver, time).dt);
  EXPECT_EQ(flow.solver.steps(), 30);
  flow.solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}), .G = 1});
  EXPECT_EQ(flow.solver.steps(), 0);
  EXPECT_EQ(stable_dt(flow.solver, time).name, "start");
  EXPECT_NEAR(stable_dt(flow.solver, time).dt, 1e-3, 1e-15);
}

// So does a force, or a velocity at a patch, that a driver's function gives.
TEST(StableStep, FollowsADriversFunctions) {
  constexpr Real period = 0.05, longest = period / 6;
  const auto swings = [](const Vec3& x, Real t) {
    return Vec3{std::sin(2 * std::numbers::pi / period * t) * x.y * (1 - x.y), 0, 0};
  };
  const Mesh mesh = test::box_mesh({.n = {8, 4, 0}});
  Conditions conditions{{"bottom", Wall{}}, {"top", Wall{}}, {"right", Opening{}}};
  conditions["left"] = Opening{};
  Solver forced(mesh, {}, {.conditions = conditions, .body_force = swings});
  conditions["left"] = FixedVelocity{swings};
  Solver driven(mesh, {}, {.conditions = conditions});
  for (Solver* solver : {&forced, &driven}) {
    solver->start([](const Vec3&) { return Vec3{}; });
    const Limit limit = stable_dt(*solver, {.end = 1});
    EXPECT_EQ(limit.name, "conditions");
    EXPECT_LT(limit.dt, longest);
  }
}

}  // namespace
}  // namespace fsi
