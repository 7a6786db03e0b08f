// A neo-Hookean slab |y| < 1/2 between viscous layers whose walls y = +-1 slide with +-V sin(w t)
// [Sugiyama11] 4.3. In simple shear B_xy = X_y, so with m = mu_s + G / (i w)
//   ks^2 = i w rho / m,  kf^2 = i w rho / mu_f,  r = m ks / (mu_f kf),
//   S, C = sinh, cosh(ks / 2),  a = V / (S cosh(kf / 2) + r C sinh(kf / 2)),
//   u = Im[U exp(i w t)],  U = a sinh(ks y) in the slab,
//   U = a S cosh(kf (y - 1/2)) + a r C sinh(kf (y - 1/2)) above,
//   B_xy = g = Im[U' / (i w) exp(i w t)],  B_xx = 1 + g^2.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi {
namespace {

using Complex = std::complex<Real>;
constexpr Complex i{0, 1};
constexpr Real w = std::numbers::pi;

struct Layers {
  Real G, mu_f, mu_s;
};

struct Exact {
  explicit Exact(const Layers& l)
      : ks(std::sqrt(i * w / (l.mu_s + l.G / (i * w)))),
        kf(std::sqrt(i * w / l.mu_f)),
        r((l.mu_s + l.G / (i * w)) * ks / (l.mu_f * kf)),
        a(1.0 / (std::sinh(ks / 2.0) * std::cosh(kf / 2.0) +
                 r * std::cosh(ks / 2.0) * std::sinh(kf / 2.0))) {}
  Complex ks, kf, r, a;

  Complex amplitude(Real y) const {
    if (y < 0) return -amplitude(-y);
    if (y <= 0.5) return a * std::sinh(ks * y);
    return a * std::sinh(ks / 2.0) * std::cosh(kf * (y - 0.5)) +
           a * r * std::cosh(ks / 2.0) * std::sinh(kf * (y - 0.5));
  }
  Real u(Real y, Real t) const { return std::imag(amplitude(y) * std::exp(i * w * t)); }
  Real displacement(Real y, Real t) const {
    return std::imag(amplitude(y) / (i * w) * std::exp(i * w * t));
  }
  Real shear(Real y, Real t) const {
    return std::imag(a * ks * std::cosh(ks * y) / (i * w) * std::exp(i * w * t));
  }
};

const char* name(KinematicsKind kind) {
  return kind == KinematicsKind::log_conformation ? "log B"
         : kind == KinematicsKind::reference_map  ? "reference map"
                                                  : "B~";
}

/// Largest error of the interface velocity over the second period, in units of the walls' speed.
/// n cells across each half; the interface lies on faces for even n, in mid-cell for odd.
Real interface_error(const Layers& layers, Index n, int steps_a_period, KinematicsKind kind) {
  test::Box box{.n = {4, 2 * n, 0}, .length = {4.0 / n, 2, 1}, .periodic = {true, false, false}};
  const Mesh mesh = test::box_mesh(box);  // y from 0 to 2: the middle is y = 1
  const Exact exact(layers);
  const FixedVelocity walls{[](const Vec3& x, Real t) {
    return Vec3{(x.y > 1 ? 1 : -1) * std::sin(w * t), 0, 0};
  }};
  Solver solver(mesh, {.rho = 1, .mu_f = layers.mu_f, .mu_s = layers.mu_s, .G = layers.G},
                {.conditions = {{"bottom", walls}, {"top", walls}}});
  solver.start([&](const Vec3& x) { return Vec3{exact.u(x.y - 1, 0), 0, 0}; });
  solver.put_solid(shapes::translate(shapes::box({200, 1, 200}), {0, 1, 0}), kind);
  if (kind == KinematicsKind::reference_map) {
    solver.body()->set_map([&](const Vec3& x) {
      return x - Vec3{exact.displacement(x.y - 1, 0), 0, 0};
    });
  } else {
    solver.body()->set_B([&](const Vec3& x) {
      const Real g = exact.shear(std::clamp(x.y - 1, -0.5, 0.5), 0);
      return SymTensor{1 + g * g, g, 0, 1, 0, 1};
    });
  }
  const Real period = 2, dt = period / steps_a_period;
  Real worst = 0;
  for (int step = 0; step < 2 * steps_a_period; ++step) {
    solver.step(dt);
    if (step < steps_a_period) continue;
    // u at the interface y = 1.5: linear between the cells on either side. The viscosity changes
    // from face to face, so the kink of the profile is smeared over this distance and the one-sided
    // limits are off by half a cell's worth of it.
    const Real y = 1.5, h = 1.0 / n;
    Real sum = 0, weights = 0;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const Real weight = std::max(0.0, 1 - std::abs(mesh.C[c].y - y) / h);
      sum += weight * solver.state().u[c].x, weights += weight;
    }
    worst = std::max(worst, std::abs(sum / weights - exact.u(0.5, solver.state().t)));
  }
  const Real amplitude = std::abs(exact.amplitude(0.5));
  std::printf(
      "slab G %g mu %g %g, %s, %d cells across: interface velocity off by %.3e, amplitude %.3e\n",
      layers.G, layers.mu_f, layers.mu_s, name(kind), n, worst, amplitude);
  return worst;
}

/// Errors with n and m cells across; the finer one is smaller. Returns it.
Real converge(const Layers& layers, Index n, Index m,
              KinematicsKind kind = KinematicsKind::log_conformation) {
  const Real coarse = interface_error(layers, n, 1000, kind),
             fine = interface_error(layers, m, 2000, kind);
  std::printf("order %.2f\n", std::log(coarse / fine) / std::log(static_cast<Real>(m) / n));
  EXPECT_LT(fine, coarse);
  return fine;
}

constexpr Layers sugiyama{.G = 5, .mu_f = 1, .mu_s = 0}, soft{.G = 0.1, .mu_f = 0.01, .mu_s = 0.01};

TEST(Slab, ElasticUnderAViscousLayer) {
  EXPECT_LE(converge(sugiyama, 32, 64), 0.02 * std::abs(Exact(sugiyama).amplitude(0.5)));
}

TEST(Slab, ThePapersKinematics) {
  EXPECT_LE(converge(sugiyama, 32, 64, KinematicsKind::left_cauchy_green),
            0.004 * std::abs(Exact(sugiyama).amplitude(0.5)));
}

TEST(Slab, ReferenceMap) {
  EXPECT_LE(converge(sugiyama, 32, 64, KinematicsKind::reference_map),
            0.025 * std::abs(Exact(sugiyama).amplitude(0.5)));
}

// The interface hardly moves here, 0.18 % of the walls.
TEST(Slab, SoftAndViscous) { EXPECT_LE(converge(soft, 32, 64), 1e-3); }

TEST(Slab, SoftAndViscousReferenceMap) {
  EXPECT_LE(converge(soft, 32, 64, KinematicsKind::reference_map), 1e-3);
}

// A cell that the interface halves carries a part of the stress only: first order.
TEST(Slab, InterfaceInMidCell) { EXPECT_LE(converge(sugiyama, 33, 65), 0.03); }

TEST(Slab, InterfaceInMidCellReferenceMap) {
  EXPECT_LE(converge(sugiyama, 33, 65, KinematicsKind::reference_map), 0.03);
}

}  // namespace
}  // namespace fsi
