// Forces at rest: the pressure balances what it can, and nothing moves; what drives a flow stays.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

constexpr Real g = 50;

struct Still {
  bool simplex = false;
  KinematicsKind kinematics = KinematicsKind::log_conformation;
  Real middle = 0.53;  ///< of a layer of thickness 0.4; its faces cut cells
  Real G = 1;
  bool later = false;  ///< whether the layer is put in after some steps
};

/// Largest velocity of cells and of fluxes after a time, in units of what falls for as long as a
/// step.
struct Speeds {
  Real cell = 0, face = 0;
};

Speeds speeds(const Still& still) {
  constexpr Index n = 16;
  const Mesh mesh = test::read_box({.n = {4, n, 0},
                                    .length = {4.0 / n, 1, 1},
                                    .simplex = still.simplex,
                                    .periodic = {"left", "right"}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01},
                {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  constexpr Real dt = 1e-3;
  for (int i = 0; still.later && i < 3; ++i) solver.step(dt);
  solver.put_solid({.shape = shapes::translate(shapes::box({200, 0.4, 200}), {0, still.middle, 0}),
                    .G = still.G,
                    .mu = 0.01,
                    .kinematics = still.kinematics,
                    .acceleration = {0, -g, 0}});
  constexpr int steps = 20;
  for (int i = 0; i < steps; ++i) solver.step(dt);
  Speeds speeds;
  for (Index c = 0; c < mesh.n_owned; ++c)
    speeds.cell = std::max(speeds.cell, norm(solver.state().u[c]) / (g * dt));
  for (Index f = 0; f < mesh.n_faces; ++f)
    speeds.face =
        std::max(speeds.face, std::abs(solver.state().phi[f]) / norm(mesh.Sf[f]) / (g * dt));
  return {global_max(speeds.cell), global_max(speeds.face)};
}

// With the force of each cell by its alpha the cells kept 0.7 to 1, the faces of triangles 0.1.
TEST(BodyForce, LeavesAHeavyLayerAtRest) {
  for (const bool later : {false, true})
    for (const bool simplex : {false, true})
      for (const auto kind : {KinematicsKind::log_conformation, KinematicsKind::reference_map,
                              KinematicsKind::left_cauchy_green}) {
        const Speeds s = speeds({.simplex = simplex, .kinematics = kind, .later = later});
        std::printf("heavy layer, %s, kinematics %d%s: cells %.2e, faces %.2e\n",
                    simplex ? "triangles" : "quads", static_cast<int>(kind),
                    later ? ", put in later" : "", s.cell, s.face);
        EXPECT_LE(s.cell, simplex ? 1e-5 : 1e-12);
        EXPECT_LE(s.face, simplex ? 1e-5 : 1e-12);
      }
}

/// The force on a disc, relative to its weight, less one.
Real excess(Index n) {
  const Mesh mesh = test::read_box({.n = {n, n, 0}});
  const FaceWeights weights(mesh);
  PressureStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false));
  const shapes::Shape disc = shapes::translate(shapes::sphere(0.21), {0.53, 0.47, 0});
  const Body body(mesh, weights, {.shape = disc, .G = 1}, {});
  solid::BodyForce weight(mesh, weights, {0, -g, 0});
  CellField<Vec3> force(mesh);
  FaceField<Real> rhie_chow_source(mesh);
  weight.apply(force, rhie_chow_source, body.alpha_f, stencil, body.band);
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) sum.add(mesh.V[c] * force[c].y);
  return sum.total() / (-g * body.filled.volume) - 1;
}

TEST(BodyForce, IsTheWeightOfTheSolidToSecondOrder) {
  const Real coarse = excess(24), fine = excess(96);
  std::printf("weight of a disc: off by %.1e and %.1e\n", coarse, fine);
  EXPECT_LE(std::abs(coarse), 1e-2);
  EXPECT_LE(std::abs(fine), 1e-2 / 12);
}

constexpr Real dt = 1e-2;

/// A mesh whose cells differ, so that the pressure needs many solves.
Mesh uneven(bool simplex, bool open) {
  const auto moved = [](const Vec3& x) {
    constexpr Real turn = 2 * std::numbers::pi;
    return x + 0.03 * std::sin(turn * x.x) * std::sin(turn * x.y) * Vec3{1, 1, 0};
  };
  test::BoxFile box{.n = {12, 10, 0}, .simplex = simplex, .moved = moved};
  if (!open) box.periodic = {"left", "right"};
  return test::read_box(box);
}

Real fastest(const Solver& solver) {
  Real u = 0;
  for (Index c = 0; c < solver.mesh().n_owned; ++c) u = std::max(u, norm(solver.state().u[c]));
  return global_max(u);
}

// From p = 0 the first step left a velocity of 0.03 in quadrilaterals.
TEST(BodyForce, ThatWallsOrPressuresBalanceMovesNothing) {
  for (const bool simplex : {false, true})
    for (const bool open : {false, true})
      for (const bool solid : {false, true}) {
        const Mesh mesh = uneven(simplex, open);
        Conditions conditions{{"bottom", Wall{}}, {"top", Wall{}}};
        const Vec3 f = open ? Vec3{30, 0, 0} : Vec3{0, -100, 0};
        if (open) conditions["left"] = Opening{}, conditions["right"] = Opening{f.x};
        Solver solver(
            mesh, {.rho = 1, .mu_f = 0.01},
            {.conditions = conditions, .body_force = [=](const Vec3&, Real) { return f; }});
        solver.start([](const Vec3&) { return Vec3{}; });
        if (solid)
          solver.put_solid(
              {.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.45, 0}), .G = 1});
        for (int i = 0; i < 3; ++i) {
          EXPECT_EQ(solver.advance(dt), dt);
          EXPECT_LE(fastest(solver), 1e-9) << simplex << open << solid << " step " << i;
        }
      }
}

// Of what drives a flow around a period nothing is balanced, neither at the start nor as it
// changes.
TEST(BodyForce, DrivesAPeriodicFlow) {
  for (const bool simplex : {false, true}) {
    const Mesh mesh =
        test::read_box({.n = {8, 8, 0}, .simplex = simplex, .periodic = {"left", "right"}});
    const auto force = [](const Vec3&, Real t) { return Vec3{1 + 50 * t, -100, 0}; };
    Solver solver(mesh, {.rho = 2, .mu_f = 0.01},
                  {.conditions = {{"bottom", Slip{}}, {"top", Slip{}}}, .body_force = force});
    solver.start([](const Vec3&) { return Vec3{}; });
    for (int i = 1; i <= 5; ++i) {
      EXPECT_EQ(solver.advance(dt), dt);
      const Real t = i * dt, exact = (t + 25 * t * t) / 2;
      for (Index c = 0; c < mesh.n_owned; ++c)
        EXPECT_LE(norm(solver.state().u[c] - Vec3{exact, 0, 0}), 1e-8);
    }
  }
}

}  // namespace
}  // namespace fsi
