// Exact flows between walls on tetrahedra: Ethier and Steinman's, and a vortex beside slip.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/flow_errors.hpp"
#include "tests/unit/support/kovasznay.hpp"

namespace fsi {
namespace {

constexpr Real pi = std::numbers::pi;

struct Flow {
  std::function<Vec3(const Vec3&, Real)> u;
  std::function<Real(const Vec3&, Real)> p;
};

// [Ethier94]: u = -a (e^ax sin(ay + dz) + e^az cos(ax + dy)) e^(-nu d^2 t), y and z in a circle.
Flow ethier_steinman(Real nu) {
  constexpr Real a = pi / 4, d = pi / 2;
  const auto part = [](Real x, Real y, Real z) {
    return -a *
           (std::exp(a * x) * std::sin(a * y + d * z) + std::exp(a * z) * std::cos(a * x + d * y));
  };
  const auto square = [](Real x, Real y, Real z) {
    return std::exp(2 * a * x) +
           2 * std::sin(a * x + d * y) * std::cos(a * z + d * x) * std::exp(a * (y + z));
  };
  return {[=](const Vec3& x, Real t) {
            return std::exp(-nu * d * d * t) *
                   Vec3{part(x.x, x.y, x.z), part(x.y, x.z, x.x), part(x.z, x.x, x.y)};
          },
          [=](const Vec3& x, Real t) {
            return -a * a / 2 * std::exp(-2 * nu * d * d * t) *
                   (square(x.x, x.y, x.z) + square(x.y, x.z, x.x) + square(x.z, x.x, x.y));
          }};
}

Flow taylor_green(Real nu, Real k) {
  return {[=](const Vec3& x, Real t) {
            return std::exp(-2 * nu * k * k * t) * Vec3{std::sin(k * x.x) * std::cos(k * x.y),
                                                        -std::cos(k * x.x) * std::sin(k * x.y), 0};
          },
          [=](const Vec3& x, Real t) {
            return std::exp(-4 * nu * k * k * t) * (std::cos(2 * k * x.x) + std::cos(2 * k * x.y)) /
                   4;
          }};
}

test::Errors run(const std::string& name, const Flow& flow, bool slip, Real nu, Real end) {
  const Mesh mesh =
      read_mesh({.file = std::string(FSI_MESHES) + "/" + name + ".msh", .periodic = {}});
  Conditions sides;
  for (const Patch& patch : mesh.patches)
    sides[patch.name] = slip ? Condition{Slip{}} : Condition{FixedVelocity{flow.u}};
  Solver solver(mesh, {.rho = 1, .mu_f = nu}, {.conditions = sides});
  solver.start([&](const Vec3& x) { return flow.u(x, 0); });
  const int steps = static_cast<int>(std::ceil(end / solver.advective_dt(0.5)));
  for (int i = 0; i < steps; ++i) solver.step(end / steps);
  const test::Errors off = test::relative_errors(solver, flow.u, flow.p, end / steps);
  std::printf("%s, %lld cells, %d steps: u %.2e, p %.2e\n", name.c_str(),
              static_cast<long long>(mesh.n_global), steps, off.u, off.p);
  return off;
}

void expect_orders(const Flow& flow, bool slip, Real nu, Real end) {
  std::vector<test::Errors> all;
  for (const char* name : {"box6", "box12", "box24"}) all.push_back(run(name, flow, slip, nu, end));
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Real u = std::log2(all[i - 1].u / all[i].u), p = std::log2(all[i - 1].p / all[i].p);
    std::printf("orders: u %.2f, p %.2f\n", u, p);
    EXPECT_GE(u, 1.8);
    EXPECT_GE(p, 1);
  }
}

TEST(Exact, EthierSteinmanIsOfSecondOrder) {
  expect_orders(ethier_steinman(0.05), false, 0.05, 0.2);
}
TEST(Exact, TaylorGreenBesideSlipIsOfSecondOrder) {
  expect_orders(taylor_green(0.01, 2 * pi), true, 0.01, 1);
}

// On the same meshes, with as many steps, icoFoam has 9.3e-2, 4.1e-2, 3.3e-2 for u and 2.4e-2,
// 1.4e-2, 1.2e-2 for p (doc/verification/icofoam.py).
TEST(Exact, KovasznayOnFreeTrianglesIsOfSecondOrder) {
  std::vector<test::Errors> off;
  for (const int n : {16, 32, 64}) {
    const std::string name = "free" + std::to_string(n);
    const Mesh mesh = read_mesh({.file = FSI_MESHES "/" + name + ".msh", .periodic = {}});
    off.push_back(test::kovasznay::run(mesh, 0.2 / n));
    std::printf("Kovasznay, %s: u %.2e, p %.2e\n", name.c_str(), off.back().u, off.back().p);
  }
  for (std::size_t i = 1; i < off.size(); ++i) {
    EXPECT_GE(std::log2(off[i - 1].u / off[i].u), 1.8);
    EXPECT_GE(std::log2(off[i - 1].p / off[i].p), 1.5);
  }
}

TEST(Exact, TaylorGreenIsLessOffThanByIcoFoam) {
  const Flow flow = taylor_green(0.01, pi);
  const std::vector<test::Errors> other{{9.3e-2, 2.4e-2}, {4.1e-2, 1.4e-2}, {3.3e-2, 1.2e-2}};
  for (const auto& [name, off] :
       {std::pair{"box8", other[0]}, std::pair{"box16", other[1]}, std::pair{"box24", other[2]}}) {
    const test::Errors ours = run(name, flow, true, 0.01, 1);
    EXPECT_LE(ours.u, off.u / 3);
    EXPECT_LE(ours.p, off.p / 2);
  }
}

}  // namespace
}  // namespace fsi
