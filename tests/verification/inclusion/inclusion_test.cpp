// A disc r < 1 of another viscosity in a fluid that is strained and turned, u = E.x + w x x far
// away, Stokes flow: with ratio the quotient of the viscosities, q = x.E.x,
//   u = c E.x within,  c = 2 / (1 + ratio),
//   u = (1 + b / r^4) E.x + 2 b (1 / r^4 - 1 / r^6) q x without,  b = c - 1,
// and the rotation besides. The box has the exact velocity at its sides, and that is so small that
// the disc stays where it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

struct Exact {
  Real ratio, angle;

  Real c() const { return 2 / (1 + ratio); }
  Vec3 u(const Vec3& x) const {
    const Real r2 = norm2(x), r4 = r2 * r2, b = c() - 1;
    const Vec3 e{std::cos(angle) * x.x + std::sin(angle) * x.y,
                 std::sin(angle) * x.x - std::cos(angle) * x.y, 0};
    const Vec3 turned{-x.y, x.x, 0};
    if (r2 < 1) return c() * e + turned;
    return (1 + b / r4) * e + (2 * b * (1 / r4 - 1 / (r4 * r2)) * dot(x, e)) * x + turned;
  }
  /// E : L.
  Real strain(const Tensor& L) const {
    return (std::cos(angle) * (L.xx - L.yy) + std::sin(angle) * (L.xy + L.yx)) / 2;
  }
};

struct Errors {
  Real u = 0;       ///< root mean square
  Real strain = 0;  ///< mean of r < 0.6, relative
};

/// n cells in the radius.
Errors errors(const Exact& exact, Index n, int steps, bool simplex = false) {
  const Vec3 centre{2.013, 2.027, 0};
  constexpr Real scale = 1e-3, rho = 1e-3, dt = 1e-3;
  const Mesh mesh = test::read_box(
      {.n = {4 * n, 4 * n, 0}, .length = {4, 4, 1}, .simplex = simplex, .periodic = {}});
  const FixedVelocity far{[&](const Vec3& x, Real) { return scale * exact.u(x - centre); }};
  Solver solver(mesh, {.rho = rho, .mu_f = 1},
                {.conditions = {{"bottom", far}, {"top", far}, {"left", far}, {"right", far}}});
  solver.start([&](const Vec3& x) { return scale * exact.u(x - centre); });
  solver.put_solid(
      {.shape = shapes::translate(shapes::sphere(1), centre), .G = 1e-9, .mu = exact.ratio});
  for (int step = 0; step < steps; ++step) solver.step(dt);
  const CellField<Tensor>& L = solver.velocity_gradient();
  Sum square, volume, strain, middle;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Vec3 x = mesh.C[c] - centre;
    square.add(mesh.V[c] * norm2((1 / scale) * solver.state().u[c] - exact.u(x)));
    volume.add(mesh.V[c]);
    if (norm(x) > 0.6) continue;
    strain.add(mesh.V[c] * exact.strain(L[c]) / scale);
    middle.add(mesh.V[c]);
  }
  return {std::sqrt(square.total() / volume.total()),
          strain.total() / middle.total() / exact.c() - 1};
}

struct Runs {
  Index cells = 16;  ///< per radius, on the finer mesh
  int steps = 40;
};

/// Bounds of the errors on the finer mesh; the coarser one has 8 cells per radius.
void expect(Real ratio, Real angle, Real u, Real strain, Runs runs = {}) {
  const Exact exact{ratio, angle};
  const Errors coarse = errors(exact, 8, runs.steps), fine = errors(exact, runs.cells, runs.steps);
  const Real order = std::log2(coarse.u / fine.u) / std::log2(static_cast<Real>(runs.cells) / 8);
  std::printf("viscosity ratio %g, axis at %g: u %.2e %.2e, order %.2f; strain %+.2f %+.2f %%\n",
              ratio, angle * 90 / std::numbers::pi, coarse.u, fine.u, order, 100 * coarse.strain,
              100 * fine.strain);
  EXPECT_LE(fine.u, u);
  EXPECT_GE(order, 1.3);
  EXPECT_LE(std::abs(fine.strain), strain);
}

TEST(Inclusion, MoreViscous) {
  expect(5, 0, 4e-4, 0.002, {.cells = 32});
  expect(5, std::numbers::pi / 2, 5e-4, 0.003, {.cells = 32});
}

TEST(Inclusion, LessViscous) {
  expect(0.2, 0, 3e-3, 0.005);
  expect(0.2, std::numbers::pi / 2, 3e-3, 0.005);
}

/// What a lasting strain makes of an elastic disc.
struct Held {
  Real flattening = 0;  ///< (a - b) / (a + b)
  Real least = 1;       ///< smallest det grad xi of its map
};

Held held(const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const Body& body = solver.bodies().front();
  Sum x, y, xx, yy, volume;
  Held now;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real V = mesh.V[c] * body.alpha[c];
    const Vec3& at = mesh.C[c];
    volume.add(V), x.add(V * at.x), y.add(V * at.y);
    xx.add(V * at.x * at.x), yy.add(V * at.y * at.y);
    if (body.alpha[c] > 0.5) now.least = std::min(now.least, body.map()->volume_ratio(c));
  }
  const Real mean_x = x.total() / volume.total(), mean_y = y.total() / volume.total();
  const Real a2 = xx.total() / volume.total() - mean_x * mean_x;
  const Real b2 = yy.total() / volume.total() - mean_y * mean_y;
  now.flattening = (std::sqrt(a2) - std::sqrt(b2)) / (std::sqrt(a2) + std::sqrt(b2));
  return now;
}

/// An elastic disc that has come to rest in the strain, to first order flattened by 2 mu / G, stays
/// as it is, whatever its viscosity. u = 0 within, so without it is that around a rigid one. The
/// disc leaves the stagnation point in the end, by exp(t): what lies off it is carried on.
void expect_held(Real ratio, bool simplex) {
  constexpr Real G = 40, t_rest = 2.5, t_end = 5, dt = 0.0075;
  const Vec3 centre{2.013, 2.027, 0};
  const Exact rigid{1e12, 0};
  const auto strain = [&](const Vec3& x) {
    const Vec3 turned{centre.y - x.y, x.x - centre.x, 0};
    return rigid.u(x - centre) - turned;
  };
  const Mesh mesh =
      test::read_box({.n = {24, 24, 0}, .length = {4, 4, 1}, .simplex = simplex, .periodic = {}});
  const FixedVelocity far{[&](const Vec3& x, Real) { return strain(x); }};
  Solver solver(mesh, {.rho = 0.1, .mu_f = 1},
                {.conditions = {{"bottom", far}, {"top", far}, {"left", far}, {"right", far}}});
  solver.start(strain);
  solver.put_solid(
      {.shape = shapes::translate(shapes::sphere(1), centre), .G = G, .mu = ratio, .rho = 0.1});
  Held first;
  for (Real t = 0; t < t_end; t += dt) {
    solver.step(dt);
    if (t < t_rest) first = held(solver);
  }
  const Held last = held(solver);
  std::printf("elastic disc, %s, viscosity ratio %g: flattening %.4f, %.4f, least volume %.3f\n",
              simplex ? "triangles" : "quads", ratio, first.flattening, last.flattening,
              last.least);
  EXPECT_NEAR(first.flattening, 2 / G, 0.1 * 2 / G);
  EXPECT_NEAR(last.flattening, first.flattening, 0.02 * first.flattening);
  EXPECT_GT(last.least, 0.9);
}

TEST(Inclusion, ElasticUnderALastingLoad) {
  for (const bool simplex : {false, true})
    for (const Real ratio : {0.1, 1.0, 10.0}) expect_held(ratio, simplex);
}

// An explicit stress that makes energy shows after many steps.
TEST(Inclusion, MuchMoreViscous) {
  expect(30, 0, 3e-3, 0.01);
  expect(100, 0, 3e-3, 0.015, {.steps = 160});
  expect(200, 0, 3e-3, 0.015, {.steps = 160});
}

void expect_steady(Real ratio, Real u, Real strain) {
  const Errors late = errors({ratio, 0}, 8, 160, true);
  std::printf("triangles, viscosity ratio %g, step 160: u %.2e; strain %+.2f %%\n", ratio, late.u,
              100 * late.strain);
  EXPECT_LE(late.u, u);
  EXPECT_LE(std::abs(late.strain), strain);
}

/// The explicit stress does not grow from step to step.
TEST(Inclusion, SteadyOnTriangles) {
  expect_steady(20, 2.5e-2, 0.05);
  expect_steady(100, 7e-2, 0.05);
}

}  // namespace
}  // namespace fsi
