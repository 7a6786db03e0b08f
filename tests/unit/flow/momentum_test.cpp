// The predictor on a periodic box of squares, where a step multiplies a wave by a known number.

#include "libfsi/flow/momentum.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/unit/support/box_file.hpp"

namespace fsi::flow {
namespace {

constexpr Index n = 16;
constexpr Real rho = 2, h = 1.0 / n, k = 2 * std::numbers::pi;
using Complex = std::complex<Real>;

/// While this lives, velocity systems that are made are solved to round-off.
struct Exactly {
  Exactly() { PetscOptionsSetValue(nullptr, "-u_ksp_rtol", "1e-15"); }
  Exactly(const Exactly&) = delete;
  Exactly& operator=(const Exactly&) = delete;
  ~Exactly() { PetscOptionsClearValue(nullptr, "-u_ksp_rtol"); }
};

/// A periodic box, u = Im(a exp(i k x)) along y, and what the predictor reads.
struct Wave {
  Wave(Real viscosity, Real speed)
      : mesh(test::read_box({.n = {n, n, 0}, .periodic = {"left", "right", "bottom", "top"}})),
        weights(mesh),
        u(mesh),
        grad_p(mesh),
        force(mesh),
        L(mesh),
        phi(mesh),
        mu(mesh, viscosity),
        kappa(mesh),
        u_b(mesh),
        momentum(mesh, weights, {}, rho, viscosity) {
    for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = speed * mesh.Sf[f].x;
    for (Index c = 0; c < mesh.n_cells; ++c) u[c] = at(c, 1);
  }
  Vec3 at(Index c, Complex a) const {
    return {0, (a * std::exp(Complex(0, k * mesh.C[c].x))).imag(), 0};
  }
  void step(Real dt) {
    momentum.predict(u, {u_b, u_b, grad_p, L, L_f, phi, mu, kappa, false, false, force, {}}, dt);
  }
  Real error(Complex a) const {
    Real worst = 0;
    for (Index c = 0; c < mesh.n_owned; ++c) worst = std::max(worst, norm(u[c] - at(c, a)));
    return global_max(worst);
  }

  Mesh mesh;
  FaceWeights weights;
  CellField<Vec3> u, grad_p, force;
  CellField<Tensor> L;
  std::vector<Tensor> L_f;
  FaceField<Real> phi, mu, kappa;
  BoundaryField<Vec3> u_b;
  Exactly exactly;  // before momentum, whose system reads the tolerance
  Momentum momentum;
};

// rho u_t = -l u, l = mu (2 - 2 cos kh) / h^2: Euler's rule for two steps, then Crank-Nicolson.
TEST(Momentum, ViscosityByCrankNicolson) {
  const Real mu = 0.3, dt = 0.02;
  Wave wave(mu, 0);
  const Real l = mu / rho * (2 - 2 * std::cos(k * h)) / (h * h) * dt;
  Real a = 1;
  for (int i = 0; i < 6; ++i) {
    wave.step(dt);
    a *= i < 2 ? 1 / (1 + l) : (1 - l / 2) / (1 + l / 2);
    EXPECT_LT(wave.error(a), 1e-12) << i;
  }
}

// u_t = -i s u, s = U sin(kh) / h, by the weights of adams_bashforth; steps of two lengths.
TEST(Momentum, ConvectionByAdamsBashforth) {
  const Real speed = 1;
  Wave wave(0, speed);
  const Complex rate(0, -speed * std::sin(k * h) / h);
  Complex a = 1, last = 0, before = 0;
  Real dt_old = 0, dt_before = 0;
  for (int i = 0; i < 6; ++i) {
    const Real dt = i % 2 == 0 ? 0.02 : 0.015;
    wave.step(dt);
    const auto w = adams_bashforth(dt, dt_old, dt_before, 1);
    const Complex now = rate * a;
    a += dt * (w[0] * now + w[1] * last + w[2] * before);
    before = last, last = now, dt_before = dt_old, dt_old = dt;
    EXPECT_LT(wave.error(a), 1e-13) << i;
  }
}

// rho u / dt = f - grad p + S of a uniform flow.
TEST(Momentum, SourcesAreTakenAsTheyAre) {
  Wave wave(0.3, 0);
  wave.u.fill({1, 1, 0});
  wave.force.fill({3, 0, 0});
  wave.grad_p.fill({0, 4, 0});
  wave.step(0.1);
  Real worst = 0;
  for (Index c = 0; c < wave.mesh.n_owned; ++c)
    worst = std::max(worst, norm(wave.u[c] - Vec3{1.15, 0.8, 0}));
  EXPECT_LT(global_max(worst), 1e-14);
}

// theta_f is larger by 1/4 - 1/l, l = dt mu g (2 / V) / rho, at the faces that are told, as long as
// they are told.
TEST(Momentum, ThetaRisesAtOneSidedFaces) {
  const Real mu = 0.3, dt = 0.5;
  Wave wave(mu, 0);
  const Index f = wave.mesh.n_internal / 2;
  const std::vector<Index> one_sided{f}, none;
  const Real l = dt * mu * 2 / (h * h) / rho;
  ASSERT_GT(l, 4);
  const auto step = [&](const std::vector<Index>& faces, Real length) {
    MomentumTerms terms{wave.u_b, wave.u_b,   wave.grad_p, wave.L, wave.L_f,  wave.phi,
                        wave.mu,  wave.kappa, false,       true,   wave.force};
    terms.one_sided = faces;
    wave.momentum.predict(wave.u, terms, length);
    return wave.momentum.theta_taken()[f];
  };
  EXPECT_NEAR(step(one_sided, dt), 1.25 - 1 / l, 1e-12);
  step(none, dt);
  EXPECT_NEAR(step(one_sided, dt), 0.75 - 1 / l, 1e-12);
  EXPECT_EQ(step(none, dt), 0.5);
  EXPECT_EQ(step(one_sided, 4 * dt / l), 0.5);  // a step that is short for viscosity
}

// l = mu dt / rho times 4 / h^2, the sum of g / V.
TEST(Momentum, ThetaRisesWhereViscositySmoothsACell) {
  Wave wave(0.3, 0);
  Momentum& momentum = wave.momentum;
  const Real mu = 0.5, dt_of_one = rho / mu * h * h / 4;
  EXPECT_EQ(momentum.theta_at(4 * dt_of_one), 0.5);
  momentum.bound_explicit_viscosity(mu);
  EXPECT_EQ(momentum.theta_at(dt_of_one), 0.5);
  EXPECT_NEAR(momentum.theta_at(4 * dt_of_one), 0.75, 1e-12);
  EXPECT_NEAR(momentum.theta_at(10 * dt_of_one), 0.9, 1e-12);
  momentum.theta = 1;
  EXPECT_EQ(momentum.theta_at(dt_of_one), 1);
}

}  // namespace
}  // namespace fsi::flow
