// What the rows of the tables hold.

#include "libfsi/run/records.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/shapes/shapes.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// A shear by 1 stores G/2 of energy per volume, whatever the determinant of the paper's B has
// become.
TEST(ElasticEnergy, OfThePapersBIsThatOfItsShape) {
  const Mesh mesh =
      test::read_box({.n = {16, 16, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.1}, {});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}),
                    .G = 3,
                    .mu = 0.1,
                    .kinematics = KinematicsKind::left_cauchy_green});
  Body& body = solver.bodies().front();
  body.set_B([](const Vec3&) { return SymTensor{2, 1, 0, 1, 0, 1}; });
  const Real whole = 3 * 0.5 * body.filled.volume, energy = elastic_energy(body);
  EXPECT_NEAR(energy, whole,
              0.02 * whole);  // B is unknown in cells with less than a tenth of solid
  auto& Bt = std::get<solid::LeftCauchyGreen>(body.kinematics).Bt;
  for (Index c = 0; c < mesh.n_cells; ++c) Bt[c].xx *= 0.6, Bt[c].xy *= 0.6, Bt[c].yy *= 0.6;
  EXPECT_NEAR(elastic_energy(body), energy, 1e-12);
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

}  // namespace
}  // namespace fsi
