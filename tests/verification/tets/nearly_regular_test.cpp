// A mesh whose nodes are off by a little gives an answer that is off by a little, of the same order
// in time: no switch hangs on round-off.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

constexpr Real w = 2 * std::numbers::pi, mu = 0.1;
constexpr Index n = 32;

/// A number in (-1, 1) of each point, the same on every rank.
Real noise(const Vec3& x, Real setup) {
  const Real s = std::sin(12.9898 * x.x + 78.233 * x.y + setup) * 43758.5453;
  return 2 * (s - std::floor(s)) - 1;
}

/// u over a wall y = 0 that slides with sin(w t), under a wall y = 1 at rest [Sugiyama11] 4.3.
Real layer(Real y, Real t) {
  const std::complex<Real> i{0, 1}, k = std::sqrt(i * w / mu);
  return std::imag(std::sinh(k * (1 - y)) / std::sinh(k) * std::exp(i * w * t));
}

/// The velocity of the layer at t = 1 by steps of dt, on quads whose inner points are moved by up
/// to `off` of a cell, at the cells in the order of their global numbers.
std::vector<Real> profile(Real off, Real dt) {
  const Real h = Real{1} / n;
  test::BoxFile box{.n = {8, n, 0}, .length = {8 * h, 1, 1}, .periodic = {"left", "right"}};
  box.moved = [&](const Vec3& x) {
    const bool edge = x.x < h / 2 || x.x > 7.5 * h || x.y < h / 2 || x.y > 1 - h / 2;
    return edge ? x : x + off * h * Vec3{noise(x, 1), noise(x, 2), 0};
  };
  const Mesh mesh = test::read_box(box);
  const FixedVelocity sliding{[](const Vec3&, Real t) { return Vec3{std::sin(w * t), 0, 0}; }};
  Solver solver(mesh, {.rho = 1, .mu_f = mu},
                {.conditions = {{"bottom", sliding}, {"top", Wall{}}}});
  solver.start([](const Vec3& x) { return Vec3{layer(x.y, 0), 0, 0}; });
  for (int step = 0; step < static_cast<int>(std::lround(1 / dt)); ++step) solver.step(dt);
  std::vector<Real> u(static_cast<std::size_t>(mesh.n_global));
  for (Index c = 0; c < mesh.n_owned; ++c) u[mesh.global_id[c]] = solver.state().u[c].x;
  return u;
}

Real difference(const std::vector<Real>& a, const std::vector<Real>& b) {
  Real square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / static_cast<Real>(a.size()));
}

TEST(NearlyRegular, TheAnswerGoesWithTheMesh) {
  const std::vector<Real> regular = profile(0, 1.0 / 64);
  for (const Real off : {1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const Real change = difference(profile(off, 1.0 / 64), regular);
    std::printf("points off by %.0e of a cell: velocity changes by %.2e\n", off, change);
    EXPECT_LE(change, 0.2 * off + 2e-9);
  }
}

TEST(NearlyRegular, TimeIsOfSecondOrderOnAllOfThem) {
  for (const Real off : {0.0, 1e-9, 1e-6, 1e-3, 1e-2, 0.1, 0.2}) {
    const std::vector<Real> finest = profile(off, 1.0 / 1024);
    const Real coarse = difference(profile(off, 1.0 / 32), finest),
               fine = difference(profile(off, 1.0 / 64), finest);
    std::printf("points off by %.0e of a cell: errors in time %.2e, %.2e, order %.2f\n", off,
                coarse, fine, std::log2(coarse / fine));
    EXPECT_LE(fine, 6e-4);
    EXPECT_GE(std::log2(coarse / fine), 1.8);
  }
}

}  // namespace
}  // namespace fsi
