// Left Cauchy-Green transport against exact deformations, and its order of advection.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/left_cauchy_green.hpp"
#include "tests/unit/solid/full.hpp"

namespace fsi {
namespace {

constexpr Real pi = std::numbers::pi;

using test::largest;

using Full = test::Full<solid::LeftCauchyGreen>;

test::BoxFile plane(Index n, bool simplex, bool periodic) {
  test::BoxFile box{.n = {n, n, 0}, .simplex = simplex};
  if (periodic) box.periodic = {"left", "right", "bottom", "top"};
  return box;
}

/// Error of B at t = 1 in a uniform velocity gradient carried along by a uniform stream.
Real homogeneous(const test::BoxFile& box, const Tensor& L, const SymTensor& B0,
                 const SymTensor& B1, int steps) {
  Full run(box);
  run.L.fill(L);
  run.kinematics.Bt.fill(B0);
  run.set_phi([](const Vec3&) { return Vec3{0.3, 0.2, 0.1}; });
  for (int i = 0; i < steps; ++i) run.step(1.0 / steps);
  return run.error([&](const Vec3&) { return B1; });
}

Tensor shear(Real rate) {
  Tensor L;
  L.xy = rate;
  return L;
}
Tensor spin(Real rate) {
  Tensor L;
  L.xy = -rate, L.yx = rate;
  return L;
}
Tensor stretch(Real x, Real y, Real z) {
  Tensor L;
  L.xx = x, L.yy = y, L.zz = z;
  return L;
}

// B = [[1 + g^2, g], [g, 1]], quadratic in t: Heun's method has no error.
TEST(Kinematics, SimpleShearIsExact) {
  const Real g = 0.8;
  const SymTensor B{1 + g * g, g, 0, 1, 0, 1};
  for (const bool simplex : {false, true}) {
    EXPECT_LE(homogeneous(plane(6, simplex, true), shear(g), identity(), B, 10), 1e-13);
    EXPECT_LE(homogeneous({.n = {4, 4, 4}, .simplex = simplex}, shear(g), identity(), B, 10),
              1e-13);
  }
}

// B = diag(e^{2 e t}, e^{-2 e t}, 1), and diag(e^{2 e t}, e^{-e t}, e^{-e t}) in space.
TEST(Kinematics, ExtensionIsOfSecondOrderInTime) {
  const Real e = 0.5;
  const SymTensor B{std::exp(2 * e), 0, 0, std::exp(-2 * e), 0, 1};
  const auto error = [&](int steps) {
    return homogeneous(plane(6, true, true), stretch(e, -e, 0), identity(), B, steps);
  };
  const Real coarse = error(20), fine = error(40);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
  // (2 e dt)^3 / 6 a step, times e^{2 e}
  EXPECT_NEAR(fine, std::exp(2 * e) / 6 / (40 * 40), 0.1 * fine);

  const SymTensor B3{std::exp(2 * e), 0, 0, std::exp(-e), 0, std::exp(-e)};
  const auto error3 = [&](int steps) {
    return homogeneous({.n = {4, 4, 4}}, stretch(e, -e / 2, -e / 2), identity(), B3, steps);
  };
  EXPECT_NEAR(std::log2(error3(20) / error3(40)), 2, 0.1);
}

// B = Q B0 Q^T.
TEST(Kinematics, RotationIsOfSecondOrderInTime) {
  const Real w = pi / 2;  // a quarter turn swaps x and y
  const SymTensor B0{2, 0.3, 0, 0.6, 0, 1}, B1{0.6, -0.3, 0, 2, 0, 1};
  const auto error = [&](int steps) {
    return homogeneous(plane(6, false, true), spin(w), B0, B1, steps);
  };
  const Real coarse = error(40), fine = error(80);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
  EXPECT_LE(fine, 2e-3);
}

// The unit tensor turns into itself: L antisymmetric gives no source at all.
TEST(Kinematics, RotationKeepsTheUndeformedState) {
  EXPECT_LE(homogeneous(plane(6, true, true), spin(3), identity(), identity(), 10), 1e-13);
}

// The flux of the same gradient through walls that are none: nothing enters through a boundary
// face, a uniform Bt stays uniform.
TEST(Kinematics, ShearWithItsOwnFlux) {
  for (const bool simplex : {false, true}) {
    Full run(plane(6, simplex, false));
    const Tensor L = shear(0.8);
    run.L.fill(L);
    run.set_phi([&](const Vec3& x) { return dot(L, x - Vec3{0.5, 0.5, 0}); });
    for (int i = 0; i < 10; ++i) run.step(0.1);
    const SymTensor B{1 + 0.64, 0.8, 0, 1, 0, 1};
    EXPECT_LE(run.error([&](const Vec3&) { return B; }), 1e-13);
  }
}

/// L2 error of a smooth profile carried once across the periodic box.
Real carried(const test::BoxFile& box, Real courant) {
  Full run(box);
  const auto profile = [](const Vec3& x) {
    const Real a = std::sin(2 * pi * x.x), b = std::cos(2 * pi * (x.x + x.y));
    return SymTensor{2 + a, 0.5 * b, 0, 2 - a * b, 0, 1 + 0.3 * a};
  };
  for (Index c = 0; c < run.mesh.n_cells; ++c) run.kinematics.Bt[c] = profile(run.mesh.C[c]);
  run.set_phi([](const Vec3&) { return Vec3{1, 1, 0}; });
  const int steps = static_cast<int>(std::lround(2 * box.n[0] / courant));
  for (int i = 0; i < steps; ++i) run.step(1.0 / steps);
  Sum squares;
  for (Index c = 0; c < run.mesh.n_owned; ++c) {
    const SymTensor e = run.kinematics.Bt[c] - profile(run.mesh.C[c]);
    squares.add(run.mesh.V[c] * (e.xx * e.xx + e.xy * e.xy + e.yy * e.yy + e.zz * e.zz));
  }
  return std::sqrt(squares.total());
}

TEST(Kinematics, AdvectionIsOfSecondOrderInSpace) {
  for (const bool simplex : {false, true}) {
    // Interior points of the triangles' grid moved off the lattice, the seams left in place.
    const auto box = [&](Index n) {
      test::BoxFile file = plane(n, simplex, true);
      if (simplex)
        file.moved = [](const Vec3& x) {
          const Real s = 0.05 * std::sin(2 * pi * x.x) * std::sin(2 * pi * x.y);
          return Vec3{x.x + s, x.y + s, 0};
        };
      return file;
    };
    const Real coarse = carried(box(24), 0.4), fine = carried(box(48), 0.4);
    const Real order = std::log2(coarse / fine);
    if (rank() == 0)
      std::printf("advection of Bt, %s: %.3e %.3e order %.2f\n", simplex ? "triangles" : "quads",
                  coarse, fine, order);
    EXPECT_GE(order, simplex ? 1.7 : 1.9);
  }
}

/// L2 error at t = 1/2 of B in u = (U + sin 2 pi y, V): with x = X + s(Y, t), y = Y + V t,
/// F_xy = ds/dY = g = (sin 2 pi y - sin 2 pi (y - V t)) / V and B = F F^T.
Real sheared(const test::BoxFile& box, Real courant) {
  constexpr Real U = 0.7, V = 1, t = 0.5;
  Full run(box);
  run.set_phi([](const Vec3& x) { return Vec3{U + std::sin(2 * pi * x.y), V, 0}; });
  for (Index c = 0; c < run.mesh.n_cells; ++c)
    run.L[c] = shear(2 * pi * std::cos(2 * pi * run.mesh.C[c].y));
  const int steps = static_cast<int>(std::lround((U + 1 + V) * t * box.n[0] / courant));
  for (int i = 0; i < steps; ++i) run.step(t / steps);
  Sum squares;
  for (Index c = 0; c < run.mesh.n_owned; ++c) {
    const Real y = run.mesh.C[c].y;
    const Real g = (std::sin(2 * pi * y) - std::sin(2 * pi * (y - V * t))) / V;
    const SymTensor e = run.kinematics.Bt[c] - SymTensor{1 + g * g, g, 0, 1, 0, 1};
    squares.add(run.mesh.V[c] * (e.xx * e.xx + 2 * e.xy * e.xy + e.yy * e.yy + e.zz * e.zz));
  }
  return std::sqrt(squares.total());
}

TEST(Kinematics, SmoothShearIsOfSecondOrder) {
  for (const bool simplex : {false, true}) {
    const Real coarse = sheared(plane(24, simplex, true), 0.4),
               fine = sheared(plane(48, simplex, true), 0.4);
    const Real order = std::log2(coarse / fine);
    if (rank() == 0)
      std::printf("B in a smooth shear, %s: %.3e %.3e order %.2f\n",
                  simplex ? "triangles" : "quads", coarse, fine, order);
    EXPECT_GE(order, simplex ? 1.7 : 1.9);
  }
}

// [Matsumiya25] 2.3: no deformation is kept where alpha < 0.1.
TEST(Kinematics, ResetsWhereThereIsHardlyASolid) {
  Full run(plane(8, false, false));
  for (Index c = 0; c < run.mesh.n_cells; ++c)
    run.alpha[c] = run.mesh.C[c].x < 0.5 ? 1 : run.mesh.C[c].x < 0.6 ? 0.09 : 0;
  run.kinematics.set_undeformed(run.alpha);
  run.alpha.fill(0);  // it dissolves, but for a column
  for (Index c = 0; c < run.mesh.n_cells; ++c)
    if (run.mesh.C[c].x < 0.125) run.alpha[c] = 1;
  run.set_phi([](const Vec3&) { return Vec3{0.1, 0, 0}; });
  run.step(0.1);
  for (Index c = 0; c < run.mesh.n_cells; ++c) {
    EXPECT_EQ(run.kinematics.Bt[c] == SymTensor{}, run.mesh.C[c].x > 0.125);
  }
}

// B = Bt / alpha^(1/2).
TEST(Kinematics, TheDeformationOfACell) {
  Full run(plane(4, false, false));
  const SymTensor B{2, 0.5, 0, 1, 0, 1};
  run.kinematics.set(0, B, 0.25);
  EXPECT_EQ(run.kinematics.Bt[0], 0.5 * B);
  EXPECT_EQ(run.kinematics.B(0, 0.25), B);
  EXPECT_EQ(run.kinematics.B(0, 0.05), identity());
  CellField<SymTensor> stored(run.mesh);
  CellField<Real> lambda(run.mesh);
  Band band(run.mesh);
  run.alpha.fill(0);
  run.alpha[0] = 0.25;
  band.rebuild(run.alpha, run.kinematics.alpha_min);
  run.kinematics.update_B(stored, lambda, run.alpha, band);
  EXPECT_LE(largest(stored[0] - B), 1e-15);
  EXPECT_NEAR(lambda[0], eigen(B).value[2], 1e-15);
}

}  // namespace
}  // namespace fsi
