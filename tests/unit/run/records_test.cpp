// What the rows of the tables hold.

#include "libfsi/run/records.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/shapes/shapes.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// An egg and a disc in a flow that turns as a whole. All directions across the egg are equally
// short.
TEST(Turned, FollowsTheAxisOfRevolution) {
  const Mesh mesh = test::read_box({.n = {20, 20, 8}, .length = {1, 1, 0.4}});
  const auto turning = [](const Vec3& x, Real = 0) { return Vec3{0.5 - x.y, x.x - 0.5, 0}; };
  const FixedVelocity given{turning};
  for (const Vec3& axes : {Vec3{0.3, 0.12, 0.12}, Vec3{0.1, 0.3, 0.15}}) {
    Solver solver(mesh, {.rho = 1, .mu_f = 1},
                  {.conditions = {{"left", given},
                                  {"right", given},
                                  {"bottom", given},
                                  {"top", given},
                                  {"back", given},
                                  {"front", given}}});
    solver.start(turning);
    solver.put_solid(
        {.shape = shapes::translate(shapes::ellipsoid(axes), {0.5, 0.5, 0.2}), .G = 1, .mu = 1});
    SolidRecord record(false);
    Real turned = 0;
    while (solver.state().t < 1.1) {
      ASSERT_GT(solver.advance(0.05), 0) << solver.report().failure;
      for (const Entry& entry : record.row(solver, *solver.body()))
        if (entry.name == "turned") turned = entry.value;
    }
    EXPECT_NEAR(turned, (solver.state().t - 0.05) * 180 / std::acos(-1.0), 2);
  }
}

// With 2.4 cells in the radius an isosurface of alpha loses 4 % of a disc's and 18 % of a sphere's.
TEST(SurfaceArea, OfASmallBody) {
  const Real pi = std::acos(-1.0), r = 0.15;
  const Mesh flat =
      test::read_box({.n = {16, 16, 0}, .periodic = {"left", "right", "bottom", "top"}});
  const Mesh deep = test::read_box(
      {.n = {16, 16, 16}, .periodic = {"left", "right", "bottom", "top", "back", "front"}});
  for (const Mesh* mesh : {&flat, &deep}) {
    Solver solver(*mesh, {}, {});
    solver.start([](const Vec3&) { return Vec3{}; });
    const bool is_flat = mesh->dim == 2;
    solver.put_solid(
        {.shape = shapes::translate(shapes::sphere(r), {0.51, 0.48, is_flat ? 0.0 : 0.5}), .G = 1});
    const Real exact = is_flat ? 2 * pi * r : 4 * pi * r * r;
    EXPECT_NEAR(surface_area(solver.bodies().front()), exact, (is_flat ? 0.04 : 0.01) * exact);
  }
}

// Where the surface lies on faces of the mesh no cell has a plane. Of a cut corner the planes leave
// out two edges.
TEST(SurfaceArea, OfABoxThatFillsWholeCells) {
  const Mesh mesh =
      test::read_box({.n = {16, 16, 0}, .periodic = {"left", "right", "bottom", "top"}});
  for (const Real shift : {0.0, 0.01}) {
    Solver solver(mesh, {}, {});
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid(
        {.shape = shapes::translate(shapes::box({0.5, 0.25, 9}), {0.5 + shift, 0.5, 0}), .G = 1});
    EXPECT_NEAR(surface_area(solver.bodies().front()), 1.5, shift > 0 ? 0.13 : 1e-12) << shift;
  }
}

// A disc of a hundred times the viscosity turns in a shear flow and takes no strain. The fluid
// around it dissipates 1 + 2 phi of what it does alone [Einstein's coefficient in two dimensions].
TEST(Dissipation, IsThatOfTheFluidAroundAVeryViscousDisc) {
  const Mesh mesh = test::read_box({.n = {32, 32, 0}, .periodic = {"left", "right"}});
  Solver solver(mesh, {.rho = 1, .mu_f = 1},
                {.conditions = {{"top", Wall{{0.5, 0, 0}}}, {"bottom", Wall{{-0.5, 0, 0}}}}});
  solver.start([](const Vec3& x) { return Vec3{x.y - 0.5, 0, 0}; });
  solver.put_solid(
      {.shape = shapes::translate(shapes::sphere(0.2), {0.51, 0.5, 0}), .G = 10, .mu = 100});
  for (int i = 0; i < 60; ++i) solver.step(2e-3);
  EXPECT_NEAR(dissipation(solver), 1 + 2 * std::acos(-1.0) * 0.04, 0.15);
}

}  // namespace
}  // namespace fsi
