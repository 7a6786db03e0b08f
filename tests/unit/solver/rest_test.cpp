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

/// A disc of modulus G in a box of 32 cells a side, in a velocity of all wavelengths and of the
/// given size.
struct Shaken {
  Mesh mesh;
  Solver solver;

  Shaken(Real G, Real mu, Real size, bool triangles)
      : mesh(test::read_box({.n = {32, 32, 0}, .simplex = triangles})),
        solver(mesh, {.rho = 1, .mu_f = mu},
               {.conditions = {
                    {"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}, {"top", Wall{}}}}) {
    solver.start([size](const Vec3& x) {
      const Real a = 1e4 * std::sin(1e3 * x.x + 2e3 * x.y),
                 b = 1e4 * std::sin(3e3 * x.x - 1e3 * x.y);
      return size * Vec3{a - std::floor(a) - 0.5, b - std::floor(b) - 0.5, 0};
    });
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.6, 0.5, 0}),
                      .G = G,
                      .mu = mu,
                      .memory = false});
  }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) solver.step(solver.elastic_dt());
  }

  Real elastic_energy(Real G) const {
    const Body& body = solver.bodies().front();
    Sum sum;
    for (Index c = 0; c < mesh.n_owned; ++c)
      if (body.alpha[c] > 0)
        sum.add(mesh.V[c] * body.alpha[c] * G / 2 * (body.B[c].xx + body.B[c].yy - 2));
    return sum.total();
  }

  Real fastest() const {
    Real most = 0;
    for (Index c = 0; c < mesh.n_owned; ++c) most = std::max(most, norm(solver.state().u[c]));
    return global_max(most);
  }
};

/// Elastic energy of a disc after 200 of the solver's elastic steps, over that after 20 of them.
Real left_of_a_shake(Real G, Real mu, bool triangles) {
  Shaken disc(G, mu, 1e-4, triangles);
  disc.run(20);
  const Real before = disc.elastic_energy(G);
  disc.run(180);
  const Real left = disc.elastic_energy(G) / before;
  std::printf("G %g, mu %g, %s: %.2e of the elastic energy left\n", G, mu,
              triangles ? "triangles" : "quads", left);
  return left;
}

// With a strain of the outermost cells beyond the work of the force waves along the surface grow,
// to 1e6 times as much and more on triangles.
TEST(Rest, WavesAlongTheSurfaceDieOut) {
  for (const bool triangles : {false, true})
    for (const Real G : {100.0, 1e4}) EXPECT_LE(left_of_a_shake(G, 0.01, triangles), 0.5);
}

// Too small a strain to tell a solid by its stress. Where the flux inside holds its excess, a stiff
// disc on triangles shakes ever faster, until its strain is 1e-7.
TEST(Rest, AShakeTooSmallForStressDiesOut) {
  for (const bool triangles : {false, true}) {
    Shaken disc(1e4, 0.01, 1e-12, triangles);
    disc.run(20);
    const Real before = disc.fastest();
    disc.run(300);
    std::printf("%s: %.2e of the velocity left\n", triangles ? "triangles" : "quads",
                disc.fastest() / before);
    EXPECT_LE(disc.fastest(), before);
  }
}

}  // namespace
}  // namespace fsi
