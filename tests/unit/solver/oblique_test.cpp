// A soft layer on a wall of oblique quads, under a lid that slides slowly.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// In the end the layer rests with the shear mu U / (G h) of the fluid above it. On quads of up to
// 43 degrees the map alternated, and with it the stress: the energy was 36 times as large at t
// = 36.
TEST(Oblique, ABondedLayerHoldsItsEnergy) {
  constexpr Real U = 0.05, G = 5, mu = 1, shear = U / 0.5 * mu / G, end = 36, dt = 0.04;
  const Mesh mesh =
      test::read_box({.n = {16, 16, 0}, .periodic = {"left", "right"}, .moved = [](const Vec3& x) {
                        return Vec3{x.x + 0.15 * std::sin(2 * std::numbers::pi * x.y), x.y, 0};
                      }});
  for (const KinematicsKind kinematics :
       {KinematicsKind::log_conformation, KinematicsKind::reference_map}) {
    Solver solver(mesh, {.rho = 1, .mu_f = mu},
                  {.conditions = {{"bottom", Wall{}}, {"top", Wall{{U, 0, 0}}}}});
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid({.shape = shapes::align(shapes::disk(5, 1), {0, 1, 0}),
                      .G = G,
                      .mu = mu,
                      .kinematics = kinematics,
                      .trim = true});
    for (Real t = 0; t < end; t += dt) solver.step(dt);
    const Body& body = *solver.body();
    Sum energy;  // G (tr B - 3) / 2
    for (Index c = 0; c < mesh.n_owned; ++c)
      energy.add(mesh.V[c] * body.alpha[c] * G / 2 * (trace(body.B_of(c)) - 3));
    const Real ratio = energy.total() / (0.5 * G / 2 * shear * shear);
    std::printf("kinematics %d: %.4f of the exact energy\n", static_cast<int>(kinematics), ratio);
    EXPECT_NEAR(ratio, 1, 0.02);
  }
}

}  // namespace
}  // namespace fsi
