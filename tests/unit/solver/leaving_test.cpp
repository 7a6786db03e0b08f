#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

Real volume(const Solver& solver) {
  Sum sum;
  for (Index c = 0; c < solver.mesh().n_owned; ++c)
    sum.add(solver.mesh().V[c] * solver.body()->alpha[c]);
  return sum.total();
}

// A disc is carried out of a channel: what is in it and what left add up, and in the end nothing
// is in it.
TEST(Leaving, WhatLeftIsCountedAndNothingStaysBehind) {
  for (const bool triangles : {false, true})
    for (const auto kind : {KinematicsKind::log_conformation, KinematicsKind::left_cauchy_green,
                            KinematicsKind::reference_map}) {
      const Mesh mesh =
          test::read_box({.n = {24, 16, 0}, .length = {1.5, 1, 1}, .simplex = triangles});
      Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                    {.conditions = {{"left", FixedVelocity{[](const Vec3&, Real) {
                                       return Vec3{1, 0, 0};
                                     }}},
                                    {"right", Opening{0}},
                                    {"bottom", Slip{}},
                                    {"top", Slip{}}}});
      solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });
      solver.put_solid({.shape = shapes::translate(shapes::sphere(0.25), {1, 0.5, 0}),
                        .G = 1,
                        .mu = 0.1,
                        .kinematics = kind});
      const Real start = volume(solver);
      int steps = 0;
      for (; steps < 400 && solver.body()->gone == 0; ++steps) {
        ASSERT_GT(solver.advance(0.01), 0) << solver.report().failure;
        ASSERT_NEAR(volume(solver) + solver.body()->volume_out, start, 1e-9 * start);
      }
      EXPECT_EQ(solver.body()->gone, 1);
      EXPECT_EQ(volume(solver), 0);
      // behind the outlet at 0.5 + radius; what is left near the walls is slower
      EXPECT_GT(steps, 70);
      EXPECT_LT(steps, 120);
      for (int i = 0; i < 5; ++i) ASSERT_GT(solver.advance(0.01), 0) << solver.report().failure;
    }
}

/// A disc that the wind has carried half out of a channel.
struct HalfOut {
  explicit HalfOut(Real radius)
      : solver(mesh, {.rho = 1, .mu_f = 0.1},
               {.conditions = {{"left", FixedVelocity{[](const Vec3&, Real) {
                                  return Vec3{1, 0, 0};
                                }}},
                               {"right", Opening{0}},
                               {"bottom", Slip{}},
                               {"top", Slip{}}}}) {
    solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });
    solver.put_solid(
        {.shape = shapes::translate(shapes::sphere(radius), {1, 0.5, 0}), .G = 1, .mu = 0.1});
    for (int i = 0; i < 30; ++i) EXPECT_GT(solver.advance(0.01), 0) << solver.report().failure;
  }
  const Mesh mesh = test::read_box({.n = {24, 16, 0}, .length = {1.5, 1, 1}});
  Solver solver;
};

// What stays behind of a disc that leaves ends with it once no cell is half full, however much it
// is; with one such cell it stays.
TEST(Leaving, AResidueWithoutAHalfFullCellLeavesWithTheRest) {
  for (const bool one_full : {false, true}) {
    HalfOut scene(0.25);
    const Mesh& mesh = scene.mesh;
    Solver& solver = scene.solver;
    Body& body = *solver.body();
    ASSERT_GT(body.volume_out, 0);
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const bool full = one_full && norm(mesh.C[c] - Vec3{1.25, 0.53, 0}) < 0.04;
      body.alpha[c] *= full ? 1 : 0.45;
    }
    mesh.halo.update(body.alpha);
    const Real left = volume(solver), out = body.volume_out;
    ASSERT_GT(left, 0.3 * body.filled.volume);
    body.advect_scratch.solid.fill(0);
    EXPECT_EQ(body.count_out(), !one_full);
    EXPECT_EQ(body.gone, one_full ? 0 : 1);
    EXPECT_NEAR(body.residue, one_full ? 0 : left, 1e-12);
    EXPECT_NEAR(body.volume_out, one_full ? out : out + left, 1e-12);
    EXPECT_NEAR(volume(solver), one_full ? left : 0, 1e-12);
  }
}

// A cell that is more than half full stays if it holds a hundredth of the disc, and leaves with the
// rest if it holds less.
TEST(Leaving, AHundredthStays) {
  for (const Real part : {0.008, 0.012}) {
    HalfOut scene(0.3);
    const Mesh& mesh = scene.mesh;
    Solver& solver = scene.solver;
    Body& body = *solver.body();
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const bool kept = norm(mesh.C[c] - Vec3{1.28, 0.53, 0}) < 0.04;
      body.alpha[c] = kept ? part * body.filled.volume / mesh.V[c] : 0;
      if (kept) {
        EXPECT_GT(body.alpha[c], 0.5);
      }
    }
    mesh.halo.update(body.alpha);
    const Real left = volume(solver);
    ASSERT_NEAR(left, part * body.filled.volume, 1e-12) << "one cell";
    EXPECT_EQ(body.count_out(), part < 0.01);
    EXPECT_EQ(body.gone, part < 0.01 ? 1 : 0);
    EXPECT_NEAR(volume(solver), part < 0.01 ? 0 : left, 1e-12);
  }
}

// Half a disc on a plane of symmetry is half of a disc.
TEST(Mirror, HalfADiscOnAPlaneOfSymmetryMovesAsTheWhole) {
  const auto run = [](Index n, Real height, Real middle, bool half) {
    const Mesh mesh = test::read_box({.n = {2 * n, half ? n / 2 : n, 0}, .length = {2, height, 1}});
    const Wall lid{{1, 0, 0}}, other{{1, 0, 0}};
    Conditions conditions{{"left", Opening{0}}, {"right", Opening{0}}, {"top", lid}};
    conditions["bottom"] = half ? Condition(Slip{}) : Condition(other);
    Solver solver(mesh, {.rho = 1, .mu_f = 0.1}, {.conditions = conditions});
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid(
        {.shape = shapes::translate(shapes::sphere(0.3), {0.7, middle, 0}), .G = 2, .mu = 0.1});
    for (int i = 0; i < 100; ++i) solver.step(0.01);
    std::array<Sum, 3> sums;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const Real V = mesh.V[c] * solver.body()->alpha[c];
      sums[0].add(V), sums[1].add(V * mesh.C[c].x), sums[2].add(V * solver.body()->B_of(c).xx);
    }
    return std::array{sums[1].total() / sums[0].total(), sums[2].total() / sums[0].total()};
  };
  const auto whole = run(32, 1, 0.5, false), half = run(32, 0.5, 0, true);
  EXPECT_NEAR(half[0], whole[0], 1e-3);
  EXPECT_NEAR(half[1], whole[1], 1e-3);
}

/// What is left of a solid that an opening has cut, after the flow has turned back: its place along
/// x, and its sizes along x and y as root mean squares.
struct Rest {
  Rest(const shapes::Shape& shape, bool memory, bool given = false) {
    const Mesh mesh = test::read_box({.n = {36, 24, 0}, .length = {1.5, 1, 1}});
    const auto wind = [](const Vec3&, Real t) { return Vec3{t < 0.25 ? 1.0 : -1.0, 0, 0}; };
    Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                  {.conditions = {{"left", FixedVelocity{wind}},
                                  {"right", given ? Condition(FixedVelocity{wind}) : Opening{0}},
                                  {"bottom", Slip{}},
                                  {"top", Slip{}}}});
    solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });
    solver.put_solid({.shape = shape, .G = 1, .mu = 0.1, .memory = memory});
    while (solver.state().t < 0.8)
      if (solver.advance(0.01) == 0) throw Error(ErrorKind::numerics, solver.report().failure);
    EXPECT_LT(solver.body()->shape_moved, 0.01);
    std::array<Sum, 4> sums;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const Real part = mesh.V[c] * solver.body()->alpha[c], above = mesh.C[c].y - 0.5;
      sums[0].add(part), sums[1].add(part * mesh.C[c].x);
      sums[2].add(part * mesh.C[c].x * mesh.C[c].x), sums[3].add(part * above * above);
    }
    std::array<Real, 4> of{};
    Sum::totals(of, sums);
    x = of[1] / of[0], along = std::sqrt(of[2] / of[0] - x * x), across = std::sqrt(of[3] / of[0]);
  }
  Real x, along, across;
};

// The map tells of a whole solid. Held to it, what an opening has left of a disc would become a
// smaller disc, and what it has left of a thin rod a thinner one.
TEST(Leaving, WhatAnOpeningHasCutComesBackAsItIs) {
  for (const Real thick : {9, 3, 2}) {
    const Real r = thick / 2 / 24;
    const shapes::Shape shape =
        shapes::translate(thick > 5 ? shapes::sphere(0.25) : shapes::capsule(r, 0.4),
                          {thick > 5 ? 1.25 : 1.2, 0.5, 0});
    for (const bool given : {false, true}) {  // the velocity at the outlet
      const Rest free(shape, false, given), held(shape, true, given);
      EXPECT_NEAR(held.x, free.x, 0.01) << thick;
      EXPECT_NEAR(held.along, free.along, 0.1 * free.along) << thick;
      EXPECT_NEAR(held.across, free.across, 0.1 * free.across) << thick;
    }
  }
}

// Half a disc at an inlet is half a disc when it has left it, and does not become a smaller disc.
TEST(Leaving, WhatTheMeshHasCutStaysAsItIs) {
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {36, 24, 0}, .length = {1.5, 1, 1}, .simplex = simplex});
    const auto wind = [](const Vec3&, Real) { return Vec3{1, 0, 0}; };
    Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                  {.conditions = {{"left", FixedVelocity{wind}},
                                  {"right", Opening{0}},
                                  {"bottom", Slip{}},
                                  {"top", Slip{}}}});
    solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.25), {0, 0.5, 0}),
                      .G = 1,
                      .mu = 0.1,
                      .trim = true});
    const auto sizes = [&] {
      std::array<Sum, 4> sums;
      for (Index c = 0; c < mesh.n_owned; ++c) {
        const Real part = mesh.V[c] * solver.body()->alpha[c];
        const Vec3 x = mesh.C[c] - Vec3{0, 0.5, 0};
        sums[0].add(part), sums[1].add(part * x.x);
        sums[2].add(part * x.x * x.x), sums[3].add(part * x.y * x.y);
      }
      std::array<Real, 4> of{};
      Sum::totals(of, sums);
      const Real x = of[1] / of[0];
      return std::array{x, std::sqrt(of[2] / of[0] - x * x), std::sqrt(of[3] / of[0])};
    };
    const auto before = sizes();
    while (solver.state().t < 0.6) ASSERT_GT(solver.advance(0.01), 0) << solver.report().failure;
    const auto after = sizes();
    EXPECT_NEAR(after[0], before[0] + 0.6, 0.03) << simplex;
    EXPECT_NEAR(after[1], before[1], 0.1 * before[1]) << simplex;
    EXPECT_NEAR(after[2], before[2], 0.1 * before[2]) << simplex;
  }
}

TEST(Mirror, ASolidMayTouchAWallButNotStickOut) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}, .length = {1, 1, 1}});
  Conditions walls{{"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}, {"top", Wall{}}};
  Solver solver(mesh, {}, {.conditions = walls});
  solver.start([](const Vec3&) { return Vec3{}; });
  EXPECT_NO_THROW(
      solver.put_solid({.shape = shapes::translate(shapes::sphere(0.25), {0.5, 0.25, 0}), .G = 1}));
  Solver other(mesh, {}, {.conditions = walls});
  other.start([](const Vec3&) { return Vec3{}; });
  EXPECT_THROW(
      other.put_solid({.shape = shapes::translate(shapes::sphere(0.25), {0.5, 0.24, 0}), .G = 1}),
      Error);
}

}  // namespace
}  // namespace fsi
