// A solid in a fluid that comes to rest: what is left of a shake dies out, at any stiffness.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// Elastic energy of a disc after 200 of the solver's elastic steps, over that after 20 of them.
Real left_of_a_shake(Real G, Real mu, bool triangles) {
  const Mesh mesh = test::read_box({.n = {32, 32, 0}, .simplex = triangles});
  Solver solver(
      mesh, {.rho = 1, .mu_f = mu},
      {.conditions = {{"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}, {"top", Wall{}}}});
  // of all wavelengths
  solver.start([](const Vec3& x) {
    const Real a = 1e4 * std::sin(1e3 * x.x + 2e3 * x.y), b = 1e4 * std::sin(3e3 * x.x - 1e3 * x.y);
    return 1e-4 * Vec3{a - std::floor(a) - 0.5, b - std::floor(b) - 0.5, 0};
  });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.6, 0.5, 0}),
                    .G = G,
                    .mu = mu,
                    .memory = false});
  const auto energy = [&] {
    const Body& body = solver.bodies().front();
    Sum sum;
    for (Index c = 0; c < mesh.n_owned; ++c)
      if (body.alpha[c] > 0)
        sum.add(mesh.V[c] * body.alpha[c] * G / 2 * (body.B[c].xx + body.B[c].yy - 2));
    return sum.total();
  };
  const Real dt = solver.elastic_dt();
  for (int i = 0; i < 20; ++i) solver.step(dt);
  const Real before = energy();
  for (int i = 0; i < 180; ++i) solver.step(dt);
  std::printf("G %g, mu %g, %s: %.2e of the elastic energy left\n", G, mu,
              triangles ? "triangles" : "quads", energy() / before);
  return energy() / before;
}

// With a strain of the outermost cells beyond the work of the force waves along the surface grow,
// to 1e6 times as much and more on triangles.
TEST(Rest, WavesAlongTheSurfaceDieOut) {
  for (const bool triangles : {false, true})
    for (const Real G : {100.0, 1e4}) EXPECT_LE(left_of_a_shake(G, 0.01, triangles), 0.5);
}

}  // namespace
}  // namespace fsi
