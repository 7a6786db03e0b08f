// Solids denser and lighter than the fluid, where the exact solution is known.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// Largest velocity of cells and of fluxes, less a uniform one.
struct Speeds {
  Real cell = 0, face = 0;
};

Speeds speeds(const Solver& solver, const Vec3& uniform = {}) {
  const Mesh& mesh = solver.mesh();
  Speeds s;
  for (Index c = 0; c < mesh.n_owned; ++c)
    s.cell = std::max(s.cell, norm(solver.state().u[c] - uniform));
  for (Index f = 0; f < mesh.n_faces; ++f)
    s.face = std::max(
        s.face, std::abs(solver.state().phi[f] - dot(uniform, mesh.Sf[f])) / norm(mesh.Sf[f]));
  return {global_max(s.cell), global_max(s.face)};
}

struct Column {
  const char* mesh;
  bool simplex = false;
  Index depth = 0;  ///< cells in z; 0: 2-D
  Real middle = 0.53;
  Real ratio = 5;
  KinematicsKind kinematics = KinematicsKind::log_conformation;
  Real above = 0;  ///< ratio of a second layer that lies on the first; 0: there is none
  Real gap = 0;    ///< of fluid between them
  int later = 0;   ///< steps after which the first layer is put in, and twice that the second
};

Speeds still(const Column& column) {
  constexpr Index n = 16;
  test::BoxFile box{.n = {4, n, column.depth},
                    .length = {4.0 / n, 1, 4.0 / n},
                    .simplex = column.simplex,
                    .periodic = {"left", "right"}};
  if (column.depth > 0) box.periodic.insert(box.periodic.end(), {"back", "front"});
  const Mesh mesh = test::read_box(box);
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01, .gravity = {0, -1, 0}},
                {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  const auto wait = [&] {
    for (int i = 0; i < column.later; ++i) solver.step(1e-2);
  };
  wait();
  solver.put_solid({.shape = shapes::translate(shapes::box({200, 0.4, 200}), {0, column.middle, 0}),
                    .G = 1,
                    .mu = 0.01,
                    .name = "layer",
                    .kinematics = column.kinematics,
                    .rho = column.ratio});
  wait();
  const Real second = column.middle + 0.2 + column.gap + 0.1;
  if (column.above > 0)
    solver.put_solid({.shape = shapes::translate(shapes::box({200, 0.2, 200}), {0, second, 0}),
                      .G = 0.5,
                      .mu = 0.01,
                      .name = "above",
                      .kinematics = column.kinematics,
                      .rho = column.above});
  constexpr int steps = 50;
  Speeds most;
  for (int i = 0; i < steps; ++i) {
    solver.step(1e-2);
    const Speeds s = speeds(solver);
    most = {std::max(most.cell, s.cell), std::max(most.face, s.face)};
  }
  return most;
}

TEST(Density, LeavesAStillColumnAtRest) {
  for (const Column& column :
       {Column{.mesh = "quads"}, Column{.mesh = "quads", .ratio = 0.5},
        Column{.mesh = "quads", .ratio = 0.1}, Column{.mesh = "quads", .ratio = 1.1},
        Column{.mesh = "quads", .ratio = 20},
        Column{.mesh = "triangles", .simplex = true, .ratio = 0.1},
        Column{.mesh = "triangles", .simplex = true, .ratio = 20},
        Column{.mesh = "quads", .middle = 0.2},
        Column{.mesh = "quads", .kinematics = KinematicsKind::reference_map},
        Column{.mesh = "triangles", .simplex = true},
        Column{.mesh = "triangles", .simplex = true, .middle = 0.2},
        Column{.mesh = "hexes", .depth = 4}, Column{.mesh = "tets", .simplex = true, .depth = 4}}) {
    const Speeds s = still(column);
    std::printf("still column, %s, ratio %g, middle %g: cells %.2e, faces %.2e\n", column.mesh,
                column.ratio, column.middle, s.cell, s.face);
    EXPECT_LE(s.cell, 1e-10);
    EXPECT_LE(s.face, 1e-10);
  }
}

// Half a disc, whose image beyond the plane of symmetry would fall the other way.
TEST(Density, RefusesAWeightAcrossAPlaneOfSymmetry) {
  const Mesh mesh = test::read_box({.n = {16, 8, 0}, .length = {2, 1, 1}});
  for (const Vec3& down : {Vec3{1, 0, 0}, Vec3{0, -1, 0}}) {
    Solver solver(
        mesh, {.rho = 1, .mu_f = 0.1, .gravity = down},
        {.conditions = {{"bottom", Slip{}}, {"top", Wall{}}, {"left", Wall{}}, {"right", Wall{}}}});
    solver.start([](const Vec3&) { return Vec3{}; });
    const Solid half{.shape = shapes::translate(shapes::sphere(0.3), {1, 0, 0}), .G = 1, .rho = 2};
    if (down.y == 0) {
      solver.put_solid(half);
    } else {
      EXPECT_THROW(solver.put_solid(half), Error);
    }
  }
  // Between two planes of symmetry it has images without end.
  Solver solver(
      mesh, {.rho = 1, .mu_f = 0.1, .gravity = {0, -1, 0}},
      {.conditions = {{"bottom", Slip{}}, {"top", Slip{}}, {"left", Wall{}}, {"right", Wall{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  EXPECT_THROW(
      solver.put_solid(
          {.shape = shapes::translate(shapes::sphere(0.6), {1, 0.5, 0}), .G = 1, .rho = 2}),
      Error);
}

/// Two solids of different densities, the light one below or above, apart or in touch.
TEST(Density, LeavesTwoLayersAtRest) {
  for (const Column& column :
       {Column{.mesh = "quads", .middle = 0.32, .above = 0.5, .gap = 0.11},
        Column{.mesh = "quads", .middle = 0.32, .ratio = 0.5, .above = 5, .gap = 0.11},
        Column{.mesh = "quads", .middle = 0.32, .above = 0.5},
        Column{.mesh = "quads", .middle = 0.32, .ratio = 0.5, .above = 5},
        Column{.mesh = "triangles", .simplex = true, .middle = 0.32, .above = 0.5, .gap = 0.11},
        Column{.mesh = "triangles", .simplex = true, .middle = 0.32, .above = 0.5},
        Column{.mesh = "hexes", .depth = 4, .middle = 0.32, .above = 0.5},
        Column{.mesh = "tets", .simplex = true, .depth = 4, .middle = 0.32, .above = 0.5}}) {
    const Speeds s = still(column);
    std::printf("two layers, %s, ratios %g and %g, gap %g: cells %.2e, faces %.2e\n", column.mesh,
                column.ratio, column.above, column.gap, s.cell, s.face);
    EXPECT_LE(s.cell, 1e-10);
    EXPECT_LE(s.face, 1e-10);
  }
}

/// Solids that are put in later, together or one after the other.
TEST(Density, LeavesLayersAtRestThatArePutInLater) {
  for (const Column& column :
       {Column{.mesh = "quads", .later = 5},
        Column{.mesh = "triangles", .simplex = true, .later = 5},
        Column{.mesh = "quads", .middle = 0.32, .above = 0.5, .gap = 0.11, .later = 5},
        Column{.mesh = "triangles", .simplex = true, .middle = 0.32, .above = 0.5, .later = 5}}) {
    const Speeds s = still(column);
    std::printf("layers after %d steps, %s, ratios %g and %g: cells %.2e, faces %.2e\n",
                column.later, column.mesh, column.ratio, column.above, s.cell, s.face);
    EXPECT_LE(s.cell, 1e-10);
    EXPECT_LE(s.face, 1e-10);
  }
}

/// A heavy disc that is put into fluid at rest falls as if it had been there from the first step.
TEST(Density, LetsADiscFallThatIsPutInLater) {
  const Mesh mesh = test::read_box({.n = {24, 24, 0}, .length = {1, 1, 1}});
  const auto fallen = [&](int later) {
    Solver solver(
        mesh, {.rho = 1, .mu_f = 0.01, .gravity = {0, -1, 0}},
        {.conditions = {{"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}, {"top", Wall{}}}});
    solver.start([](const Vec3&) { return Vec3{}; });
    for (int i = 0; i < later; ++i) solver.step(5e-3);
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.6, 0}),
                      .G = 1,
                      .mu = 0.01,
                      .rho = 3});
    std::array<Real, 2> speed{};
    for (int i = 1; i <= 20; ++i) {
      solver.step(5e-3);
      if (i == 1) speed[0] = speeds(solver).cell;
    }
    speed[1] = speeds(solver).cell;
    std::printf("disc put in after %d steps: %.6f in its first, %.6f in its 20th\n", later,
                speed[0], speed[1]);
    return speed;
  };
  // The first steps of a run are those of backward Euler.
  const std::array<Real, 2> at_once = fallen(0), late = fallen(4);
  EXPECT_NEAR(late[0], at_once[0], 0.03 * at_once[0]);
  EXPECT_NEAR(late[1], at_once[1], 4e-4 * at_once[1]);
}

/// A light disc, much more viscous than the fluid, turns with a sheared fluid almost rigidly. Its
/// viscous forces balance its pressure, and what they leave is small against both.
TEST(Density, KeepsALightViscousDiscSmoothOnTriangles) {
  constexpr Index n = 16;
  const Mesh mesh = test::read_box({.n = {n, n, 0},
                                    .length = {1, 1, 1},
                                    .simplex = true,
                                    .periodic = {"left", "right"},
                                    .moved = [](const Vec3& x) {
                                      const auto wave = [](Real s) { return std::sin(37 * s); };
                                      const Real part = 0.2 / n * x.y * (1 - x.y) * 4;
                                      const Real across = std::sin(shapes::pi * x.x);
                                      return x + part * across * Vec3{wave(x.y), wave(x.x), 0};
                                    }});
  const auto steepest = [&](Real rho) {
    Solver solver(mesh, {.rho = 1, .mu_f = 0.05},
                  {.conditions = {{"bottom", Wall{}}, {"top", Wall{{1, 0, 0}}}}});
    solver.start([](const Vec3& x) { return Vec3{x.y, 0, 0}; });
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.25), {0.5, 0.6, 0}),
                      .G = 1,
                      .mu = 2.4,
                      .rho = rho});
    Real most = 0;
    for (int i = 0; i < 150; ++i) {
      solver.step(4e-3);
      for (Index f = 0; i > 50 && f < mesh.n_internal; ++f)
        most = std::max(
            most, norm(solver.state().u[mesh.neighbour[f]] - solver.state().u[mesh.owner[f]]) /
                      norm(mesh.d[f]));
    }
    return global_max(most);
  };
  const Real alike = steepest(1), light = steepest(0.1);
  std::printf("viscous disc: largest difference of velocities over distance %.3f, light %.3f\n",
              alike, light);
  EXPECT_LE(light, 1.1 * alike);
}

/// A layer across a column without ends falls with all of the fluid: f of the height, ratio r,
///   (1 + f (r - 1)) du/dt = f (r - 1) g.
Speeds falling(bool simplex, Real ratio, bool held) {
  constexpr Index n = 16;
  constexpr Real part = 0.4, dt = 5e-3;
  const Mesh mesh = test::read_box({.n = {4, n, 0},
                                    .length = {4.0 / n, 1, 1},
                                    .simplex = simplex,
                                    .periodic = {"left", "right", "bottom", "top"}});
  FlowSetup setup{.axis = {0, 1, 0}};
  if (held) setup.mean_velocity = 1;
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01, .gravity = {0, -1, 0}}, setup);
  solver.start([&](const Vec3&) { return held ? Vec3{0, 1, 0} : Vec3{}; });
  solver.put_solid({.shape = shapes::translate(shapes::box({200, part, 200}), {0, 0.53, 0}),
                    .G = 1,
                    .mu = 0.01,
                    .rho = ratio});
  constexpr int steps = 100;
  for (int i = 0; i < steps; ++i) solver.step(dt);
  const Real excess = part * (ratio - 1);
  const Vec3 u = held ? Vec3{0, 1, 0} : Vec3{0, -excess / (1 + excess) * solver.state().t, 0};
  return speeds(solver, u);
}

TEST(Density, LetsALayerFallWithTheFluid) {
  for (const bool held : {false, true})
    for (const bool simplex : {false, true})
      for (const Real ratio : {0.5, 2.0, 5.0}) {
        const Speeds s = falling(simplex, ratio, held);
        std::printf("%s layer, %s, ratio %g: cells %.2e, faces %.2e\n", held ? "held" : "falling",
                    simplex ? "triangles" : "quads", ratio, s.cell, s.face);
        EXPECT_LE(s.cell, simplex ? 4e-3 : 1e-3);
        EXPECT_LE(s.face, simplex ? 3e-3 : 1e-4);
      }
}

}  // namespace
}  // namespace fsi
