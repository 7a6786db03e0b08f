// A neo-Hookean slab |y| < 1/2 of another density between viscous layers and still walls y = +-1,
// driven by a force per volume F cos(w t) along x on all of it. With m = mu_s + G / (i w),
//   ks^2 = i w rho_s / m,  kf^2 = i w rho_f / mu_f,  u = Re[U exp(i w t)],
//   U = F / (i w rho_s) + a cosh(ks y) in the slab,
//   U = F / (i w rho_f) + b cosh(kf (y - 1/2)) + c sinh(kf (y - 1/2)) above,
// the velocity and m U' continuous, U(1) = 0; B_xy = Re[U' / (i w) exp(i w t)].

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

using Complex = std::complex<Real>;
constexpr Complex i{0, 1};
constexpr Real w = 2 * std::numbers::pi, mu = 0.1, G = 1;

struct Exact {
  explicit Exact(Real ratio)
      : m(mu + G / (i * w)),
        ks(std::sqrt(i * w * ratio / m)),
        kf(std::sqrt(i * w / mu)),
        s(1.0 / (i * w * ratio)),
        f(1.0 / (i * w)) {
    // b = s - f + a cosh(ks / 2),  c = a m ks sinh(ks / 2) / (mu kf)
    const Complex C = std::cosh(kf / 2.0), S = std::sinh(kf / 2.0);
    a = -(f + (s - f) * C) /
        (std::cosh(ks / 2.0) * C + m * ks * std::sinh(ks / 2.0) / (mu * kf) * S);
  }
  Complex m, ks, kf, s, f, a;

  Complex amplitude(Real y) const {
    y = std::abs(y);
    if (y <= 0.5) return s + a * std::cosh(ks * y);
    const Complex b = s - f + a * std::cosh(ks / 2.0);
    const Complex c = a * m * ks * std::sinh(ks / 2.0) / (mu * kf);
    return f + b * std::cosh(kf * (y - 0.5)) + c * std::sinh(kf * (y - 0.5));
  }
  Real u(Real y, Real t) const { return std::real(amplitude(y) * std::exp(i * w * t)); }
  Real shear(Real y, Real t) const {
    return std::real(a * ks * std::sinh(ks * y) / (i * w) * std::exp(i * w * t));
  }
};

/// u after one period, and the root mean square of what it is off by as a part of its amplitude.
struct Result {
  std::vector<Real> u;
  Real error = 0;
};

Result run(Real ratio, Index n, int steps, bool triangles) {
  const Mesh mesh = test::read_box({.n = {4, 2 * n, 0},
                                    .length = {4.0 / n, 2, 1},
                                    .simplex = triangles,
                                    .periodic = {"left", "right"}});
  const Exact exact(ratio);
  Solver solver(
      mesh, {.mu_f = mu},
      {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}, .body_force = [](const Vec3&, Real t) {
         return Vec3{std::cos(w * t), 0, 0};
       }});
  solver.start([&](const Vec3& x) { return Vec3{exact.u(x.y - 1, 0), 0, 0}; });
  solver.put_solid({.shape = shapes::translate(shapes::box({200, 1, 200}), {0, 1, 0}),
                    .G = G,
                    .mu = mu,
                    .rho = ratio});
  solver.body()->set_B([&](const Vec3& x) {
    const Real g = exact.shear(std::clamp(x.y - 1, -0.5, 0.5), 0);
    return SymTensor{1 + g * g, g, 0, 1, 0, 1};
  });
  for (int step = 0; step < steps; ++step) solver.step(1.0 / steps);
  Sum square, weight;
  Result result;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    result.u.push_back(solver.state().u[c].x);
    const Real y = mesh.C[c].y - 1;
    square.add(mesh.V[c] * std::pow(solver.state().u[c].x - exact.u(y, solver.state().t), 2));
    weight.add(mesh.V[c] * std::norm(exact.amplitude(y)));
  }
  result.error = std::sqrt(square.total() / weight.total());
  return result;
}

/// Order between two errors of steps and cells twice as fine.
Real order(Real ratio, Index n, Index m, int steps, bool triangles) {
  const Real coarse = run(ratio, n, steps, triangles).error;
  const Real fine = run(ratio, m, 2 * steps, triangles).error;
  const Real observed = std::log(coarse / fine) / std::log(static_cast<Real>(m) / n);
  std::printf("slab of density %g, %s, %d and %d across: u %.2e %.2e, order %.2f\n", ratio,
              triangles ? "triangles" : "quads", n, m, coarse, fine, observed);
  return observed;
}

TEST(HeavySlab, SurfaceOnFaces) {
  for (const Real ratio : {0.5, 5.0}) EXPECT_GE(order(ratio, 32, 64, 200, false), 1.8);
}

TEST(HeavySlab, SurfaceInMidCell) {
  for (const Real ratio : {2.0, 5.0}) EXPECT_GE(order(ratio, 33, 65, 200, false), 1.5);
}

TEST(HeavySlab, Triangles) {
  for (const Real ratio : {2.0}) EXPECT_GE(order(ratio, 16, 32, 200, true), 1.7);
}

Real difference(const std::vector<Real>& a, const std::vector<Real>& b) {
  Real most = 0;
  for (std::size_t c = 0; c < a.size(); ++c) most = std::max(most, std::abs(a[c] - b[c]));
  return most;
}

/// In time alone: largest difference to a run with many steps.
TEST(HeavySlab, Time) {
  for (const Real ratio : {0.5, 2.0, 5.0}) {
    constexpr Index n = 16;
    constexpr int steps = 50, many = 800;
    const std::vector<Real> limit = run(ratio, n, many, false).u;
    const Real coarse = difference(run(ratio, n, steps, false).u, limit),
               fine = difference(run(ratio, n, 2 * steps, false).u, limit);
    std::printf("slab of density %g, %d and %d steps a period: u %.2e %.2e, order %.2f\n", ratio,
                steps, 2 * steps, coarse, fine, std::log2(coarse / fine));
    EXPECT_GE(std::log2(coarse / fine), 1.8);
  }
}

}  // namespace
}  // namespace fsi
