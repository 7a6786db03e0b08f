// A stiff disc of radius a settles midway between plates at a distance H, along them, slowly, in a
// fluid that does not flow in the mean. With k = 2 a / H the force per length that holds the speed
// U is 4 pi mu U / Lambda [Faxen46],
//   Lambda = -ln k - 0.9157 + 1.7244 k^2 - 1.7302 k^4 + 2.4056 k^6 - 4.5913 k^8,
// so that U = (rho_s - rho_f) g a^2 Lambda / (4 mu).

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/unit/support/box_file.hpp"
#include "tests/verification/settling/settle.hpp"

namespace fsi {
namespace {

constexpr Real a = 0.125, mu = 1, G = 400;

/// What is denser than five times the fluid takes longer to reach its speed, and is to bend no
/// more.
Real slower(Real ratio) { return std::max(Real{1}, ratio / 5); }
Real gravity(Real ratio) { return 25 / slower(ratio); }

Real exact(Real ratio) {
  const Real k = 2 * a, k2 = k * k;
  const Real Lambda =
      -std::log(k) - 0.9157 + k2 * (1.7244 + k2 * (-1.7302 + k2 * (2.4056 - k2 * 4.5913)));
  return (ratio - 1) * gravity(ratio) * a * a * Lambda / (4 * mu);
}

/// Speed over the exact one.
Real speed(Real ratio, Index n, bool triangles) {
  const Mesh mesh = test::read_box({.n = {3 * n, n, 0},
                                    .length = {3, 1, 1},
                                    .simplex = triangles,
                                    .periodic = {"left", "right"}});
  Solver solver(mesh, {.mu_f = mu, .gravity = {gravity(ratio), 0, 0}},
                {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}, .mean_velocity = 0});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid(
      {.shape = shapes::translate(shapes::sphere(a), {1, 0.5, 0}), .G = G, .mu = mu, .rho = ratio});
  const Real end = 0.2 * slower(ratio);
  const Real u = test::settled_speed(solver, end, 50);
  std::printf("disc of density %g, %d %s between the plates: U %.5f, over Faxen's %.4f\n", ratio, n,
              triangles ? "pairs of triangles" : "cells", u, u / exact(ratio));
  return u / exact(ratio);
}

TEST(Settling, Ratios) {
  for (const Real ratio : {0.5, 1.1, 2.0, 5.0}) EXPECT_NEAR(speed(ratio, 32, false), 1, 0.015);
}

/// What the options take at most.
TEST(Settling, Extremes) {
  for (const Real ratio : {0.1, 10.0, 20.0}) EXPECT_NEAR(speed(ratio, 32, false), 1, 0.03);
}

TEST(Settling, Triangles) { EXPECT_NEAR(speed(2, 32, true), 1, 0.03); }

TEST(Settling, TrianglesFine) {
  for (const Real ratio : {0.1, 0.5, 1.1, 5.0, 10.0, 20.0})
    EXPECT_NEAR(speed(ratio, 32, true), 1, 0.03);
}

TEST(Settling, Fine) {
  for (const Real ratio : {0.5, 1.1, 2.0, 5.0}) EXPECT_NEAR(speed(ratio, 64, false), 1, 0.01);
}

}  // namespace
}  // namespace fsi
