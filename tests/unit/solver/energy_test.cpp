#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/solver/energy.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// A uniform force in a periodic box: u = f t / rho, and all the work is kinetic energy.
TEST(EnergyBalance, TheWorkOfAForceIsStored) {
  const Mesh mesh =
      test::read_box({.n = {6, 6, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver(mesh, {.rho = 2, .mu_f = 0.1}, {.body_force = [](const Vec3&, Real) {
                  return Vec3{3, 0, 0};
                }});
  solver.start([](const Vec3&) { return Vec3{}; });
  EnergyBalance energy(solver);
  for (int i = 0; i < 20; ++i) {
    solver.step(0.01);
    energy.add(solver, 0.01);
  }
  EXPECT_NEAR(energy.stored(), 0.5 * 2 * std::pow(3 * 0.2 / 2, 2), 1e-10);
  EXPECT_NEAR(energy.work(), energy.stored(), 1e-10);
  EXPECT_LE(energy.part_made(), 1e-9);
}

// Flow between plates that slide: once it is steady, the work is what viscosity takes,
//   mu (U / H)^2 per volume and time.
TEST(EnergyBalance, ThePlatesDoWhatViscosityTakes) {
  const Mesh mesh = test::read_box({.n = {4, 8, 0}, .periodic = {"left", "right"}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.5},
                {.conditions = {{"top", Wall{{1, 0, 0}}}, {"bottom", Wall{}}}});
  solver.start([](const Vec3& x) { return Vec3{x.y, 0, 0}; });
  EnergyBalance energy(solver);
  for (int i = 0; i < 10; ++i) {
    solver.step(0.02);
    energy.add(solver, 0.02);
  }
  EXPECT_NEAR(energy.work(), 0.5 * 0.2, 1e-9);
  EXPECT_EQ(energy.made(), 0);
}

// An elastic disc far too stiff for the step: it makes its energy from nothing.
TEST(EnergyBalance, ToldFromAFarTooStiffSolid) {
  const auto made = [](Real G) {
    const Mesh mesh = test::read_box({.n = {32, 32, 0}});
    Solver solver(
        mesh, {.rho = 1, .mu_f = 0.01, .mu_s = 0.01, .G = G},
        {.conditions = {
             {"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}, {"top", Wall{{1, 0, 0}}}}});
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid(shapes::translate(shapes::sphere(0.2), {0.6, 0.5, 0}));
    EnergyBalance energy(solver);
    for (int i = 0; i < 150; ++i) {
      const Real dt = solver.advance(
          std::min({solver.advective_dt(0.5), solver.elastic_dt(), solver.boundary_dt(0.5)}));
      if (dt == 0) break;
      energy.add(solver, dt);
    }
    return energy.part_made();
  };
  EXPECT_LE(made(0.1), 0.05);
  EXPECT_GE(made(1e3), 0.3);
}

}  // namespace
}  // namespace fsi
