// A neo-Hookean slab |y| < 1/2 between viscous layers whose walls y = +-1 slide with +-V sin(w t)
// [Sugiyama11] 4.3. In simple shear B_xy = X_y, so with m = mu_s + G / (i w)
//   ks^2 = i w rho / m,  kf^2 = i w rho / mu_f,  r = m ks / (mu_f kf),
//   S, C = sinh, cosh(ks / 2),  a = V / (S cosh(kf / 2) + r C sinh(kf / 2)),
//   u = Im[U exp(i w t)],  U = a sinh(ks y) in the slab,
//   U = a S cosh(kf (y - 1/2)) + a r C sinh(kf (y - 1/2)) above,
//   B_xy = g = Im[U' / (i w) exp(i w t)],  B_xx = 1 + g^2.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

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

/// n cells across each half: the interface lies on faces for even n, in mid-cell for odd.
struct Setup {
  Layers layers;
  KinematicsKind kind = KinematicsKind::log_conformation;
  bool triangles = false;
  int shorter = 2;    ///< steps on the finer mesh
  bool half = false;  ///< the upper half alone, on a wall at rest: u(0) = 0
  bool tets = false;  ///< of a box four cells deep
};

const char* name(KinematicsKind kind) {
  return kind == KinematicsKind::log_conformation ? "log B"
         : kind == KinematicsKind::reference_map  ? "reference map"
                                                  : "B~";
}

struct Errors {
  Real u = 0;     ///< at the interface, in units of the walls' speed
  Real B_xy = 0;  ///< over the slab, as a part of B_xy
};

Mesh mesh_of(const Setup& setup, Index n) {
  // y from 0 to 2: the middle is y = 1
  test::BoxFile box{.n = {4, 2 * n, 0},
                    .length = {4.0 / n, 2, 1},
                    .simplex = setup.triangles,
                    .periodic = {"left", "right"}};
  if (setup.half) {
    box.n[1] = n, box.length.y = 1;
    box.moved = [](const Vec3& x) { return x + Vec3{0, 1, 0}; };
  }
  if (setup.tets) {
    box.n[2] = 4, box.length.z = box.length.x, box.simplex = true;
    box.periodic = {"left", "right", "back", "front"};
  }
  return test::read_box(box);
}

/// Root mean square of u - exact over the slab's cells within two layers of its surface.
Real interface_error(const Solver& solver, const Exact& exact, Index n) {
  const Mesh& mesh = solver.mesh();
  Sum square, weight;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real y = mesh.C[c].y - 1;
    if (std::abs(y) > 0.5 + 1e-9 || std::abs(y) < 0.5 - 2.0 / n) continue;
    square.add(mesh.V[c] * std::pow(solver.state().u[c].x - exact.u(y, solver.state().t), 2));
    weight.add(mesh.V[c]);
  }
  return std::sqrt(square.total() / weight.total());
}

/// Root mean squares over the slab of B_xy - exact, and of the exact.
std::array<Real, 2> strain_error(const Solver& solver, const Exact& exact) {
  const Mesh& mesh = solver.mesh();
  std::array<Sum, 3> sums;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real y = mesh.C[c].y - 1, g = exact.shear(y, solver.body()->t);
    if (std::abs(y) > 0.5) continue;
    sums[0].add(mesh.V[c] * std::pow(solver.body()->B_of(c).xy - g, 2));
    sums[1].add(mesh.V[c] * g * g), sums[2].add(mesh.V[c]);
  }
  return {std::sqrt(sums[0].total() / sums[2].total()),
          std::sqrt(sums[1].total() / sums[2].total())};
}

/// The solid's exact state at t = 0.
void deform(Body& body, const Exact& exact) {
  if (std::holds_alternative<solid::ReferenceMap>(body.kinematics)) {
    body.set_map([&](const Vec3& x) { return x - Vec3{exact.displacement(x.y - 1, 0), 0, 0}; });
    return;
  }
  body.set_B([&](const Vec3& x) {
    const Real g = exact.shear(std::clamp(x.y - 1, -0.5, 0.5), 0);
    return SymTensor{1 + g * g, g, 0, 1, 0, 1};
  });
}

/// Largest errors over the second period.
Errors errors(const Setup& setup, Index n, int steps_a_period) {
  const Mesh mesh = mesh_of(setup, n);
  const Layers& layers = setup.layers;
  const Exact exact(layers);
  const FixedVelocity walls{[](const Vec3& x, Real t) {
    return Vec3{(x.y > 1 ? 1 : -1) * std::sin(w * t), 0, 0};
  }};
  Solver solver(
      mesh, {.rho = 1, .mu_f = layers.mu_f},
      {.conditions = {{"bottom", setup.half ? Condition{Wall{}} : walls}, {"top", walls}}});
  solver.start([&](const Vec3& x) { return Vec3{exact.u(x.y - 1, 0), 0, 0}; });
  const Real middle = setup.half ? 1.25 : 1, height = setup.half ? 0.5 : 1;
  solver.put_solid({.shape = shapes::translate(shapes::box({200, height, 200}), {0, middle, 0}),
                    .G = layers.G,
                    .mu = layers.mu_s,
                    .kinematics = setup.kind});
  deform(*solver.body(), exact);
  Real u = 0, B = 0, scale = 0;
  for (int step = 0; step < 2 * steps_a_period; ++step) {
    solver.step(2.0 / steps_a_period);
    if (step < steps_a_period) continue;
    const auto [off, size] = strain_error(solver, exact);
    u = std::max(u, interface_error(solver, exact, n)), B = std::max(B, off);
    scale = std::max(scale, size);
  }
  return {u, B / scale};
}

/// Errors with n and m cells across, printed with their order.
std::array<Errors, 2> converge(const Setup& setup, Index n, Index m) {
  const int steps = setup.triangles ? 2000 : setup.tets ? 300 : 1000;
  const std::array<Errors, 2> e{errors(setup, n, steps), errors(setup, m, setup.shorter * steps)};
  const Real finer = std::log(static_cast<Real>(m) / static_cast<Real>(n));
  const Layers& l = setup.layers;
  std::printf(
      "slab%s G %g, mu %g in %g, %s, %s, %d and %d across: u %.2e %.2e of %.2e, order %.2f; B_xy "
      "%.2e %.2e, order %.2f\n",
      setup.half ? " on a wall," : "", l.G, l.mu_s, l.mu_f, name(setup.kind),
      setup.tets        ? "tets"
      : setup.triangles ? "triangles"
                        : "quads",
      n, m, e[0].u, e[1].u, std::abs(Exact(l).amplitude(0.5)), std::log(e[0].u / e[1].u) / finer,
      e[0].B_xy, e[1].B_xy, std::log(e[0].B_xy / e[1].B_xy) / finer);
  return e;
}

constexpr Layers viscous{.G = 5, .mu_f = 1, .mu_s = 1}, elastic{.G = 5, .mu_f = 1, .mu_s = 0},
    soft{.G = 0.1, .mu_f = 0.01, .mu_s = 0.01};

Real order(Real coarse, Real fine) { return std::log2(coarse / fine); }

TEST(Slab, OneViscosity) {
  const auto [coarse, fine] = converge({viscous}, 32, 64);
  EXPECT_LE(fine.u, 2e-4);
  EXPECT_LE(fine.B_xy, 3e-4);
  EXPECT_GE(order(coarse.u, fine.u), 1.8);
  EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.8);
}

TEST(Slab, InterfaceInMidCell) {
  const auto [coarse, fine] = converge({viscous}, 33, 65);
  EXPECT_LE(fine.u, 1.2e-4);
  EXPECT_LE(fine.B_xy, 5e-4);
  EXPECT_GE(order(coarse.u, fine.u), 1.5);
  EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.5);
}

TEST(Slab, Triangles) {
  const auto [coarse, fine] = converge({viscous, KinematicsKind::log_conformation, true}, 16, 32);
  EXPECT_LE(fine.u, 2.2e-4);
  EXPECT_LE(fine.B_xy, 4e-4);
  EXPECT_GE(order(coarse.u, fine.u), 1.7);
  EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.8);
}

TEST(SlabMore, TrianglesInMidCell) {
  const auto [coarse, fine] = converge({viscous, KinematicsKind::log_conformation, true}, 17, 33);
  EXPECT_LE(fine.u, 2e-4);
  EXPECT_LE(fine.B_xy, 4e-4);
  EXPECT_GE(order(coarse.u, fine.u), 1.5);
  EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.7);
}

// With solvers to 1e-10 the finer mesh has 7.7e-4 and 2.84e-3 in any order of the cells. The
// default tolerance moves both by up to 7 %.
TEST(SlabMore, OnAWallOfTetrahedra) {
  const auto [coarse, fine] = converge({.layers = viscous, .half = true, .tets = true}, 8, 16);
  EXPECT_LE(coarse.u, 2e-3);
  EXPECT_LE(fine.u, 8.5e-4);
  EXPECT_LE(coarse.B_xy, 7e-3);
  EXPECT_LE(fine.B_xy, 3e-3);
  EXPECT_GE(order(coarse.u, fine.u), 1.1);
  EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.1);
}

TEST(Slab, OnAWall) {
  for (const bool triangles : {false, true}) {
    const Index n = triangles ? 16 : 32;
    const auto [coarse, fine] =
        converge({.layers = viscous, .triangles = triangles, .half = true}, n, 2 * n);
    EXPECT_LE(fine.u, 2.5e-4);
    EXPECT_LE(fine.B_xy, 5e-4);
    EXPECT_GE(order(coarse.u, fine.u), 1.7);
    EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.7);
  }
}

// The interface hardly moves here, 0.18 % of the walls; the layer at it is 0.05 thick.
TEST(Slab, SoftAndViscous) {
  const auto [coarse, fine] = converge({soft}, 64, 128);
  EXPECT_LE(fine.u, 2e-5);
  EXPECT_GE(order(coarse.u, fine.u), 1.8);
  EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.8);
}

// [Sugiyama11]: an inviscid slab.
TEST(Slab, InviscidSolid) {
  const auto [coarse, fine] = converge({elastic}, 32, 64);
  EXPECT_LE(fine.u, 0.0012 * std::abs(Exact(elastic).amplitude(0.5)));
  EXPECT_LE(fine.B_xy, 1.2e-3);
  EXPECT_GE(order(coarse.u, fine.u), 1.8);
  EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.8);
}

TEST(SlabMore, InviscidSolidInMidCell) {
  const auto [coarse, fine] = converge({elastic}, 33, 65);
  EXPECT_LE(fine.u, 0.003 * std::abs(Exact(elastic).amplitude(0.5)));
  EXPECT_LT(fine.u, coarse.u);
}

/// Steps in proportion to the cells (shorter 2) or to the cells squared (4).
Setup two(Real mu_s, int shorter) {
  return {.layers = {.G = 5, .mu_f = 1, .mu_s = mu_s}, .shorter = shorter};
}

TEST(Slab, TwoViscosities) {
  for (const Real mu_s : {0.2, 5.0}) {
    const auto [coarse, fine] = converge(two(mu_s, 2), 32, 64);
    const Real amplitude = std::abs(Exact(two(mu_s, 2).layers).amplitude(0.5));
    EXPECT_LE(fine.u, (mu_s > 1 ? 2e-4 : 0.001) * amplitude);
    EXPECT_GE(order(coarse.u, fine.u), 1.8);
    EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.8);
  }
}

TEST(SlabMore, TwoViscositiesShortSteps) {
  for (const Real mu_s : {0.0, 0.2, 5.0}) {
    const auto [coarse, fine] = converge(two(mu_s, 4), 16, 32);
    const Real amplitude = std::abs(Exact(two(mu_s, 4).layers).amplitude(0.5));
    // with 5 the error of the mesh; the step's had the other sign when it was of first order
    EXPECT_LE(fine.u, (mu_s > 1 ? 2.6e-4 : 0.01) * amplitude);
    EXPECT_GE(order(coarse.u, fine.u), 1.8);
    EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.9);
  }
}

TEST(SlabMore, TwoViscositiesInMidCell) {
  for (const Real mu_s : {0.2, 5.0}) {
    // with 5 the error at 17 is as small by chance
    const auto [coarse, fine] = converge(two(mu_s, 4), mu_s > 1 ? 33 : 17, mu_s > 1 ? 65 : 33);
    EXPECT_LE(fine.B_xy, mu_s > 1 ? 1.2e-4 : 1.6e-3);
    EXPECT_GE(order(coarse.u, fine.u), 1.4);
    EXPECT_GE(order(coarse.B_xy, fine.B_xy), 1.8);
  }
}

TEST(Slab, ThePapersKinematics) {
  const auto [coarse, fine] = converge({elastic, KinematicsKind::left_cauchy_green}, 32, 64);
  EXPECT_LE(fine.u, 0.03 * std::abs(Exact(elastic).amplitude(0.5)));
  EXPECT_LT(fine.u, coarse.u);
}

void expect_map(const Setup& setup, Index n, Real limit, Real order) {
  const auto [coarse, fine] = converge(setup, n, 2 * n - n % 2);
  EXPECT_LE(fine.u, limit);
  EXPECT_GE(std::log2(coarse.u / fine.u), order);
  EXPECT_LT(fine.B_xy, coarse.B_xy);
}

TEST(SlabMore, ReferenceMap) {
  constexpr KinematicsKind map = KinematicsKind::reference_map;
  expect_map({viscous, map}, 32, 2e-4, 1.7);
  expect_map({viscous, map}, 33, 1.2e-4, 1.7);
  expect_map({soft, map}, 32, 5e-5, 1.6);
  expect_map({soft, map}, 33, 6e-5, 1.5);
}

TEST(SlabMore, ReferenceMapOnTriangles) {
  expect_map({viscous, KinematicsKind::reference_map, true}, 32, 8e-4, 1);
}

TEST(SlabMore, InviscidReferenceMap) {
  constexpr KinematicsKind map = KinematicsKind::reference_map;
  expect_map({elastic, map}, 32, 2e-3, 1.4);
  expect_map({elastic, map}, 33, 2e-3, 1.2);
}

}  // namespace
}  // namespace fsi
