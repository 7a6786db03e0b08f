// The logarithm of B: its rate, its transport against exact deformations, its extension outward.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/log_conformation.hpp"
#include "libfsi/solid/one_sided.hpp"
#include "tests/unit/solid/full.hpp"

namespace fsi {
namespace {

constexpr Real pi = std::numbers::pi;

using test::largest;

/// L . B + B . L^T.
SymTensor stretching(const Tensor& L, const SymTensor& B) {
  const Vec3 x{B.xx, B.xy, B.xz}, y{B.xy, B.yy, B.yz}, z{B.xz, B.yz, B.zz};
  const Vec3 Lx = dot(L, x), Ly = dot(L, y), Lz = dot(L, z);  // columns of L . B
  return {2 * Lx.x, Lx.y + Ly.x, Lx.z + Lz.x, 2 * Ly.y, Ly.z + Lz.y, 2 * Lz.z};
}

struct Random {
  std::mt19937 engine{7};
  Real operator()(Real scale) {
    return std::uniform_real_distribution<Real>(-scale, scale)(engine);
  }
  SymTensor symmetric(Real scale) {
    return {(*this)(scale), (*this)(scale), (*this)(scale),
            (*this)(scale), (*this)(scale), (*this)(scale)};
  }
  Tensor full(Real scale) {
    Tensor t;
    for (Real* v : {&t.xx, &t.xy, &t.xz, &t.yx, &t.yy, &t.yz, &t.zx, &t.zy, &t.zz})
      *v = (*this)(scale);
    return t;
  }
};

TEST(LogTensor, ExpAndLogAreInverse) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const SymTensor psi = random.symmetric(2);
    EXPECT_LE(largest(solid::log(solid::exp(psi)) - psi), 1e-12);
    EXPECT_GT(eigen(solid::exp(psi)).value[0], 0);
    EXPECT_NEAR(det(solid::exp(psi)), std::exp(trace(psi)), 1e-11 * std::exp(trace(psi)));
  }
}

// Central differences of log(B) along dB/dt = L B + B L^T, with all eigenvalues apart, two or three
// of them equal or nearly so.
TEST(LogTensor, RateIsTheDerivativeOfTheLogarithm) {
  Random random;
  std::vector<SymTensor> states{{}, {1, 0, 0, 1, 0, -2}, {1, 0, 0, 1 + 1e-9, 0, -2}};
  for (int i = 0; i < 100; ++i) states.push_back(random.symmetric(1));
  for (const SymTensor& psi : states) {
    const Tensor L = random.full(1);
    const SymTensor B = solid::exp(psi), dB = stretching(L, B);
    const Real e = 1e-5;
    const SymTensor difference = (1 / (2 * e)) * (solid::log(B + e * dB) - solid::log(B - e * dB));
    EXPECT_LE(largest(solid::log_rate(L, psi) - difference), 2e-7);
  }
}

// Without strain psi only turns: trace and norm stay.
TEST(LogTensor, SpinKeepsTheStretches) {
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Real a = random(1), b = random(1), c = random(1);
    const Tensor W{0, a, b, -a, 0, c, -b, -c, 0};
    const SymTensor psi = random.symmetric(1), rate = solid::log_rate(W, psi);
    EXPECT_NEAR(trace(rate), 0, 1e-13);
    EXPECT_NEAR(psi.xx * rate.xx + psi.yy * rate.yy + psi.zz * rate.zz +
                    2 * (psi.xy * rate.xy + psi.xz * rate.xz + psi.yz * rate.yz),
                0, 1e-13);
  }
}

using Full = test::Full<solid::LogConformation>;

test::BoxFile plane(Index n, bool simplex) {
  return {.n = {n, n, 0}, .simplex = simplex, .periodic = {"left", "right", "bottom", "top"}};
}

/// Error of B at t = 1 in a uniform velocity gradient carried along by a uniform stream.
Real homogeneous(const test::BoxFile& box, const Tensor& L, const SymTensor& B0,
                 const SymTensor& B1, int steps) {
  Full run(box);
  run.L.fill(L);
  run.set_B([&](const Vec3&) { return B0; });
  run.set_phi([](const Vec3&) { return Vec3{0.3, 0.2, 0.1}; });
  for (int i = 0; i < steps; ++i) run.step(1.0 / steps);
  return run.error([&](const Vec3&) { return B1; });
}

Real order_in_time(const test::BoxFile& box, const Tensor& L, const SymTensor& B0,
                   const SymTensor& B1) {
  const Real coarse = homogeneous(box, L, B0, B1, 40), fine = homogeneous(box, L, B0, B1, 80);
  EXPECT_LE(fine, 2e-3);
  return std::log2(coarse / fine);
}

// B = [[1 + g^2, g], [g, 1]] in shear, Q B0 Q^T in a quarter turn.
TEST(LogConformation, ShearAndRotationAreOfSecondOrderInTime) {
  const Real g = 0.8;
  Tensor shear, spin;
  shear.xy = g;
  spin.xy = -pi / 2, spin.yx = pi / 2;
  const SymTensor B{1 + g * g, g, 0, 1, 0, 1};
  EXPECT_GE(order_in_time(plane(6, true), shear, identity(), B), 1.9);
  EXPECT_GE(order_in_time({.n = {4, 4, 4}}, shear, identity(), B), 1.9);
  EXPECT_GE(
      order_in_time(plane(6, false), spin, {2, 0.5, 0, 0.625, 0, 1}, {0.625, -0.5, 0, 2, 0, 1}),
      1.9);
}

// psi grows linearly in time: Heun's method has no error.
TEST(LogConformation, ExtensionIsExact) {
  Tensor L;
  L.xx = 0.5, L.yy = -0.5;
  const Real e = std::exp(1.0);
  EXPECT_LE(homogeneous(plane(6, true), L, identity(), {e, 0, 0, 1 / e, 0, 1}, 10), 1e-13);
  L.yy = L.zz = -0.25;
  const Real r = std::exp(-0.5);
  EXPECT_LE(homogeneous({.n = {4, 4, 4}}, L, identity(), {e, 0, 0, r, 0, r}, 10), 1e-13);
}

TEST(LogConformation, AdvectionIsOfSecondOrderInSpace) {
  const auto profile = [](const Vec3& x) {
    const Real a = std::sin(2 * pi * x.x), b = std::cos(2 * pi * (x.x + x.y));
    return solid::exp(SymTensor{0.5 * a, 0.5 * b, 0, -0.5 * a, 0, 0});
  };
  for (const bool simplex : {false, true}) {
    const auto error = [&](Index n) {
      Full run(plane(n, simplex));
      run.set_B(profile);
      run.set_phi([](const Vec3&) { return Vec3{1, 1, 0}; });
      const int steps = static_cast<int>(5 * n);
      for (int i = 0; i < steps; ++i) run.step(1.0 / steps);
      return run.mean_error(profile);
    };
    const Real coarse = error(24), fine = error(48), order = std::log2(coarse / fine);
    if (rank() == 0)
      std::printf("advection of log B, %s: %.3e %.3e order %.2f\n", simplex ? "triangles" : "quads",
                  coarse, fine, order);
    EXPECT_GE(order, 1.7);
  }
}

// u = (U + sin 2 pi y, V): F_xy = g = (sin 2 pi y - sin 2 pi (y - V t)) / V and B = F F^T.
TEST(LogConformation, SmoothShearIsOfSecondOrder) {
  constexpr Real U = 0.7, V = 1, t = 0.5;
  for (const bool simplex : {false, true}) {
    const auto error = [&](Index n) {
      Full run(plane(n, simplex));
      run.set_phi([](const Vec3& x) { return Vec3{U + std::sin(2 * pi * x.y), V, 0}; });
      for (Index c = 0; c < run.mesh.n_cells; ++c)
        run.L[c].xy = 2 * pi * std::cos(2 * pi * run.mesh.C[c].y);
      const int steps = static_cast<int>(4 * n);
      for (int i = 0; i < steps; ++i) run.step(t / steps);
      return run.mean_error([&](const Vec3& x) {
        const Real g = (std::sin(2 * pi * x.y) - std::sin(2 * pi * (x.y - V * t))) / V;
        return SymTensor{1 + g * g, g, 0, 1, 0, 1};
      });
    };
    const Real coarse = error(24), fine = error(48), order = std::log2(coarse / fine);
    if (rank() == 0)
      std::printf("log B in a smooth shear, %s: %.3e %.3e order %.2f\n",
                  simplex ? "triangles" : "quads", coarse, fine, order);
    EXPECT_GE(order, 1.7);
  }
}

// One step of a shear by 3, which Heun's method alone would miss by half, goes in parts.
TEST(LogConformation, ALargeStrainIsTakenInParts) {
  Tensor L;
  L.xy = 3;
  for (const Real turned : {0.0, 1.0}) {
    Full run(plane(6, true));
    run.L.fill(turned > 0 ? transpose(L) : L);
    run.kinematics.mark(run.alpha);
    const solid::Strain strain = run.kinematics.transport(
        run.alpha, {run.phi, run.u, run.L, run.stencil, run.weights}, 1, run.grad);
    const SymTensor exact =
        turned > 0 ? SymTensor{1, 3, 0, 10, 0, 1} : SymTensor{10, 3, 0, 1, 0, 1};
    EXPECT_LE(run.error([&](const Vec3&) { return exact; }), 0.05 * 10);
    EXPECT_LE(global_max(strain.of_part), 0.5);
    EXPECT_GT(global_max(strain.rate), 1);
  }
}

// Whatever the velocity gradient, B stays positive definite and isochoric.
TEST(LogConformation, BStaysPositiveDefinite) {
  Random random;
  Full run({.n = {4, 4, 4}});
  for (int step = 0; step < 50; ++step) {
    run.L.fill(random.full(4));
    run.step(0.05);
  }
  for (Index c = 0; c < run.mesh.n_owned; ++c) {
    EXPECT_NEAR(trace(run.kinematics.psi[c]), 0, 1e-11);
    EXPECT_GT(eigen(run.kinematics.B(c, 1)).value[0], 0);
  }
}

/// A disc or ball in a box, psi given inside; what the extension makes of it.
struct Ball {
  explicit Ball(const test::BoxFile& box) : full(box), inside(full.mesh) {
    const Mesh& mesh = full.mesh;
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Real r = norm(mesh.C[c] - Vec3{0.5, 0.5, mesh.dim == 3 ? 0.5 : 0});
      inside[c] = r < 0.25 ? 1 : 0;
      full.alpha[c] = inside[c];
    }
  }
  Full full;
  CellField<Real> inside;
};

// A uniform psi stays as it is and reaches three rings beyond the solid, no further.
TEST(Extension, CarriesAUniformTensorOutward) {
  const SymTensor psi{0.3, 0.1, 0, -0.3, 0, 0};
  for (const test::BoxFile& box :
       {test::BoxFile{.n = {16, 16, 0}}, test::BoxFile{.n = {16, 16, 0}, .simplex = true},
        test::BoxFile{.n = {12, 12, 12}}}) {
    Ball ball(box);
    Full& run = ball.full;
    for (Index c = 0; c < run.mesh.n_cells; ++c) run.kinematics.psi[c] = ball.inside[c] * psi;
    run.kinematics.resume(run.alpha, run.grad);
    CellField<Real> ring(run.mesh);
    for (Index c = 0; c < run.mesh.n_cells; ++c) ring[c] = ball.inside[c];
    for (int i = 0; i < 3; ++i) {
      CellField<Real> wider(run.mesh);
      for (Index c = 0; c < run.mesh.n_owned; ++c) {
        wider[c] = ring[c];
        for (const Index n : run.mesh.cell_neighbours[c]) wider[c] = std::max(wider[c], ring[n]);
      }
      run.mesh.halo.update(wider);
      ring.swap(wider);
    }
    for (Index c = 0; c < run.mesh.n_cells; ++c)
      EXPECT_LE(largest(run.kinematics.psi[c] - ring[c] * psi), 1e-15);
  }
}

// A strained body at rest in itself, a stream through it and shear in the fluid around: nothing of
// that shear enters with the stream, however long the step.
TEST(LogConformation, StrainOfTheFluidStaysOutside) {
  const SymTensor psi{0.3, 0.1, 0, -0.3, 0, 0};
  for (const test::BoxFile& box :
       {test::BoxFile{.n = {16, 16, 0}}, test::BoxFile{.n = {16, 16, 0}, .simplex = true},
        test::BoxFile{.n = {12, 12, 12}}}) {
    Ball ball(box);
    Full& run = ball.full;
    for (Index c = 0; c < run.mesh.n_cells; ++c) {
      run.kinematics.psi[c] = ball.inside[c] * psi;
      run.L[c] = (1 - ball.inside[c]) * Tensor{2, 9, 0, 5, -2, 0, 0, 0, 0};
    }
    run.kinematics.resume(run.alpha, run.grad);
    run.set_phi([](const Vec3&) { return Vec3{1, 0.5, 0}; });
    run.step(0.02);
    for (Index c = 0; c < run.mesh.n_owned; ++c)
      EXPECT_LE(ball.inside[c] * largest(run.kinematics.psi[c] - psi), 1e-14);
  }
}

// A velocity with a kink at x = 0.5, linear on either side: the gradient of the known side, beside
// the kink as well; of cells that no known neighbour surrounds, what is given in its place.
TEST(OneSided, GradientOfTheKnownSide) {
  const Tensor solid{1, 2, 0, 0.5, -1, 0, 0, 0, 0}, given{9, 9, 9, 9, 9, 9, 9, 9, 9};
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {8, 8, 0}, .simplex = simplex});
    CellField<Vec3> u(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Vec3 x = mesh.C[c] - Vec3{0.5, 0.5, 0};
      u[c] = dot(solid, x) + (x.x > 0 ? 7 * x.x : 0) * Vec3{1, 3, 0};
    }
    const auto known = [&](Index c) { return mesh.C[c].x < 0.5; };
    const auto inner = [&](Index c) { return mesh.C[c].x < 0.25; };
    CellField<Tensor> field(mesh, given);
    for (Index c = 0; c < mesh.n_cells; ++c)
      if (inner(c)) field[c] = solid;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      if (!known(c)) continue;
      const Tensor L = solid::one_sided_gradient(field, u, known, inner, solid::nowhere, mesh, c);
      EXPECT_LE(std::abs(L.xx - 1) + std::abs(L.xy - 2), 1e-12);
      EXPECT_LE(std::abs(L.yx - 0.5) + std::abs(L.yy + 1), 1e-12);
      EXPECT_EQ(L.xz, field[c].xz);  // nothing spreads along z
    }
    const auto none = [](Index) { return false; };
    EXPECT_EQ(solid::one_sided_gradient(field, u, none, none, solid::nowhere, mesh, 0).xx,
              field[0].xx);
  }
}

// Known cells keep their own; the first ring takes the weighted mean of the known cells beside it.
TEST(Extension, MeanOfTheNeighbours) {
  Ball ball({.n = {16, 16, 0}});
  const Mesh& mesh = ball.full.mesh;
  CellField<SymTensor> T(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) T[c].xx = ball.inside[c] * (1 + mesh.C[c].x);
  Band known(mesh);
  known.rebuild(ball.inside, solid::alpha_known);
  solid::Extension extension(mesh);
  extension.mark(ball.inside, known);
  extension.constant(T, CellField<Real>(mesh, 1));
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Real sum = 0, weights = 0;
    for (const Index n : mesh.cell_neighbours[c]) {
      const Real w = ball.inside[n] / norm2(mesh.C[n] - mesh.C[c]);
      sum += w * (1 + mesh.C[n].x), weights += w;
    }
    if (ball.inside[c] > 0) {
      EXPECT_EQ(T[c].xx, 1 + mesh.C[c].x);
    } else if (weights > 0) {
      EXPECT_NEAR(T[c].xx, sum / weights, 1e-14);
    }
  }
}

}  // namespace
}  // namespace fsi
