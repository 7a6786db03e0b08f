// Observed orders on exact solutions of the Navier-Stokes equations, on cells that are neither
// orthogonal nor straight: triangles, and quads of a grid bent by a smooth map.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "libfsi/solver/energy.hpp"
#include "tests/unit/support/box_file.hpp"
#include "tests/unit/support/flow_errors.hpp"
#include "tests/unit/support/kovasznay.hpp"

namespace fsi {
namespace {

constexpr Real pi = std::numbers::pi;

using test::Errors;
using test::errors;

Mesh bent(Index n, bool simplex, bool bend) {
  test::BoxFile box{.n = {n, n, 0}, .simplex = simplex};
  if (bend)
    box.moved = [](const Vec3& x) {
      const Real s = std::sin(2 * pi * x.x) * std::sin(2 * pi * x.y);
      return Vec3{x.x + 0.06 * s, x.y - 0.06 * s, 0};
    };
  return test::read_box(box);
}

/// Order of u and p between 16 and 32 cells per side, at a Courant number of about 0.4.
void expect_orders(const char* name, bool simplex, bool bend, Real u_order) {
  const Real part = simplex ? 0.08 : 0.2;
  const Errors a = test::kovasznay::run(bent(16, simplex, bend), part / 16),
               b = test::kovasznay::run(bent(32, simplex, bend), part / 32);
  const Real u = std::log2(a.u / b.u), p = std::log2(a.p / b.p);
  if (rank() == 0)
    std::printf("Kovasznay, %s: u %.3e %.3e order %.2f, p %.3e %.3e order %.2f\n", name, a.u, b.u,
                u, a.p, b.p, p);
  EXPECT_GE(u, u_order);
  EXPECT_GE(p, 1.5);
}

TEST(ObliqueFlows, KovasznayBentQuads) { expect_orders("bent quads", false, true, 1.9); }
TEST(ObliqueFlows, KovasznayTriangles) { expect_orders("triangles", true, false, 1.7); }
TEST(ObliqueFlows, KovasznayBentTriangles) { expect_orders("bent triangles", true, true, 1.7); }

Errors taylor_green(Index n, Real t_end, int steps) {
  const Mesh mesh = test::read_box(
      {.n = {n, n, 0}, .simplex = true, .periodic = {"left", "right", "bottom", "top"}});
  constexpr Real nu = 0.01, k = 2 * pi;
  Solver solver(mesh, {.rho = 1, .mu_f = nu}, {});
  const auto decay = [](Real t) { return std::exp(-2 * nu * k * k * t); };
  const auto u = [&](const Vec3& x, Real t) {
    return decay(t) *
           Vec3{std::sin(k * x.x) * std::cos(k * x.y), -std::cos(k * x.x) * std::sin(k * x.y), 0};
  };
  const auto p = [&](const Vec3& x, Real t) {
    return (std::cos(2 * k * x.x) + std::cos(2 * k * x.y)) * decay(t) * decay(t) / 4;
  };
  solver.start([&](const Vec3& x) { return u(x, 0); });
  for (int i = 0; i < steps; ++i) solver.step(t_end / steps);
  const Real middle = t_end - t_end / steps / 2;  // of the last step, to which its pressure belongs
  return errors(
      solver, [&](const Vec3& x) { return u(x, t_end); },
      [&](const Vec3& x) { return p(x, middle); });
}

TEST(ObliqueFlows, TaylorGreenTriangles) {
  const Errors a = taylor_green(16, 0.5, 100), b = taylor_green(32, 0.5, 200),
               c = taylor_green(64, 0.5, 400);
  const Real u = std::log2(b.u / c.u), p = std::log2(b.p / c.p);
  if (rank() == 0)
    std::printf(
        "Taylor-Green, triangles: u %.3e %.3e %.3e order %.2f, p %.3e %.3e %.3e order %.2f\n", a.u,
        b.u, c.u, u, a.p, b.p, c.p, p);
  EXPECT_GE(u, 1.7);
  EXPECT_GE(p, 1.5);
}

/// Kinetic energy of the vortex sin(pi x) sin(pi y) between four planes of slip, turned by that
/// angle, after steps in which viscosity passes many cells.
Real vortex(Real angle, bool simplex) {
  const Real c = std::cos(angle), s = std::sin(angle);
  const auto turned = [c, s](const Vec3& x) {
    return Vec3{c * x.x - s * x.y, s * x.x + c * x.y, 0};
  };
  const Mesh mesh = test::read_box({.n = {16, 16, 0}, .simplex = simplex, .moved = turned});
  const Conditions planes{{"bottom", Slip{}}, {"top", Slip{}}, {"left", Slip{}}, {"right", Slip{}}};
  Solver solver(mesh, {.rho = 1, .mu_f = 1}, {.conditions = planes});
  solver.start([&](const Vec3& x) {
    const Real a = pi * (c * x.x + s * x.y), b = pi * (c * x.y - s * x.x);
    return turned({std::sin(a) * std::cos(b), -std::cos(a) * std::sin(b), 0});
  });
  for (int i = 0; i < 10; ++i) solver.step(0.04);
  return kinetic_energy(solver);
}

// The matrix couples the components where a plane of slip is normal to no axis. With its diagonal
// alone the explicit rest makes energy.
TEST(ObliqueFlows, PlanesOfSlipMayStandAtAnyAngle) {
  for (const bool simplex : {false, true}) {
    const Real level = vortex(0, simplex);
    for (const Real degrees : {20, 45, 70}) {
      const Real ratio = vortex(degrees * pi / 180, simplex) / level;
      if (rank() == 0)
        std::printf("%s at %g degrees: energy of the vortex over that at 0 %.8f\n",
                    simplex ? "triangles" : "quads", degrees, ratio);
      EXPECT_NEAR(ratio, 1, 1e-4);
    }
  }
}

}  // namespace
}  // namespace fsi
