// Observed orders on exact solutions of the Navier-Stokes equations, on uniform quads.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "tests/unit/support/box_mesh.hpp"
#include "tests/unit/support/flow_errors.hpp"
#include "tests/unit/support/kovasznay.hpp"

namespace fsi {
namespace {

constexpr Real pi = std::numbers::pi;

using test::Errors;
using test::errors;

Errors taylor_green(Index n, int steps) {
  const Mesh mesh = test::box_mesh({.n = {n, n, 0}, .periodic = {true, true, false}});
  constexpr Real nu = 0.01, k = 2 * pi, t_end = 0.5;
  Solver solver(mesh, {.rho = 1, .mu_f = nu}, {});
  const auto u = [](const Vec3& x, Real t) {
    const Real F = std::exp(-2 * nu * k * k * t);
    return Vec3{std::sin(k * x.x) * std::cos(k * x.y) * F,
                -std::cos(k * x.x) * std::sin(k * x.y) * F, 0};
  };
  const auto p = [](const Vec3& x, Real t) {
    const Real F = std::exp(-2 * nu * k * k * t);
    return (std::cos(2 * k * x.x) + std::cos(2 * k * x.y)) * F * F / 4;
  };
  solver.start([&](const Vec3& x) { return u(x, 0); });
  for (int i = 0; i < steps; ++i) solver.step(t_end / steps);
  EXPECT_LE(flow::divergence_max(solver.state().phi, mesh), 1e-6);
  return errors(
      solver, [&](const Vec3& x) { return u(x, t_end); },
      [&](const Vec3& x) { return p(x, t_end - t_end / steps / 2); });
}

// Small steps: the Rhie-Chow flux carries an error of order dt h^2 that would hide the spatial one.
// The pressure of a step belongs to its middle, t - dt / 2.
TEST(ExactFlows, TaylorGreenOrder) {
  const Errors coarse = taylor_green(32, 1000), fine = taylor_green(64, 2000);
  RecordProperty("u_error", std::to_string(fine.u));
  const Real order = std::log2(coarse.u / fine.u), p_order = std::log2(coarse.p / fine.p);
  std::printf("Taylor-Green u %.3e %.3e order %.2f, p %.3e %.3e order %.2f\n", coarse.u, fine.u,
              order, coarse.p, fine.p, p_order);
  EXPECT_GE(order, 1.9);
  EXPECT_GE(p_order, 1.5);
}

Errors kovasznay(Index n, Real courant = 0.2) {
  return test::kovasznay::run(test::box_mesh({.n = {n, n, 0}}), courant / n);
}

TEST(ExactFlows, KovasznayOrder) {
  const Errors coarse = kovasznay(16), fine = kovasznay(32);
  const Real order = std::log2(coarse.u / fine.u), p_order = std::log2(coarse.p / fine.p);
  std::printf("Kovasznay u %.3e %.3e order %.2f, p %.3e %.3e order %.2f\n", coarse.u, fine.u, order,
              coarse.p, fine.p, p_order);
  EXPECT_GE(order, 1.9);
  EXPECT_GE(p_order, 1.5);
}

// The steady flow on quads does not depend on the step, although the damping in the face flux does.
TEST(ExactFlows, KovasznayOnQuadsIsTheSameWithAnyStep) {
  const Errors one = kovasznay(16), other = kovasznay(16, 0.05);
  std::printf("Kovasznay, dt n 0.2 and 0.05: u %.3e %.3e, p %.3e %.3e\n", one.u, other.u, one.p,
              other.p);
  EXPECT_NEAR(other.u / one.u, 1, 0.05);
  EXPECT_NEAR(other.p / one.p, 1, 0.05);
}

TEST(ExactFlows, AChannelHoldsItsMeanAndFindsPoiseuille) {
  const Index n = 16;
  const Mesh mesh = test::box_mesh({.n = {4, n, 0}, .periodic = {true, false, false}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}, .mean_velocity = 0.5});
  solver.start([](const Vec3&) { return Vec3{0.5, 0, 0}; });
  for (int i = 0; i < 400; ++i) {
    solver.step(0.02);
    ASSERT_NEAR(solver.mean_velocity(), 0.5, 1e-13);
  }
  // u = 6 U y (1 - y), S = 12 mu U; the wall cells' one-sided shear makes S of order h^2.
  EXPECT_NEAR(solver.driving_gradient(), 0.6, 0.6 * 2.0 / (n * n));
}

TEST(ExactFlows, RestStaysAtRest) {
  const Mesh mesh = test::box_mesh({.n = {6, 6, 6}});
  Conditions walls;
  for (const Patch& patch : mesh.patches) walls[patch.name] = Wall{};
  Solver solver(mesh, {}, {.conditions = walls});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (int i = 0; i < 3; ++i) solver.step(0.1);
  for (Index c = 0; c < mesh.n_cells; ++c) ASSERT_EQ(norm(solver.state().u[c]), 0);
}

}  // namespace
}  // namespace fsi
