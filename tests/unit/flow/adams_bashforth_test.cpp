// The extrapolation of explicit terms: exact means of parabolas and lines, order with uneven steps.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "libfsi/flow/momentum.hpp"

namespace fsi::flow {
namespace {

/// The weighted values of t^n, n = 0, 1, 2, at 0, -dt_old and -dt_old - dt_before.
Real weighted(int n, Real dt, Real dt_old, Real dt_before, Real ab3_weight = 1) {
  const auto w = adams_bashforth(dt, dt_old, dt_before, ab3_weight);
  return w[0] * std::pow(0.0, n) + w[1] * std::pow(-dt_old, n) +
         w[2] * std::pow(-dt_old - dt_before, n);
}

TEST(AdamsBashforth, ExactMeanOfAParabola) {
  for (const Real dt : {0.1, 0.3, 0.5})
    for (int n = 0; n <= 2; ++n)
      EXPECT_NEAR(weighted(n, dt, 0.3, 0.2), std::pow(dt, n) / (n + 1), 1e-15) << dt << ' ' << n;
}

TEST(AdamsBashforth, EqualSteps) {
  const auto w = adams_bashforth(0.1, 0.1, 0.1, 1);
  EXPECT_NEAR(w[0], 23.0 / 12, 1e-14);
  EXPECT_NEAR(w[1], -16.0 / 12, 1e-14);
  EXPECT_NEAR(w[2], 5.0 / 12, 1e-14);
}

TEST(AdamsBashforth, LinesWhereLittleIsKnown) {
  // before the third step, and in a step much longer than the last one
  for (const auto& [dt, before] : {std::pair{0.3, 0.0}, std::pair{0.7, 0.2}}) {
    EXPECT_EQ(adams_bashforth(dt, 0.3, before, 1)[2], 0);
    EXPECT_NEAR(weighted(0, dt, 0.3, before), 1, 1e-15);
    EXPECT_NEAR(weighted(1, dt, 0.3, before), std::min(dt, 0.6) / 2, 1e-15);
  }
  EXPECT_EQ(adams_bashforth(300, 0.3, 0.2, 1), (std::array<Real, 3>{2, -1, 0}));
  // after a step much longer than the one before it, a rest before an event
  EXPECT_EQ(adams_bashforth(0.3, 0.3, 0.01, 1)[2], 0);
  EXPECT_EQ(adams_bashforth(0.3, 0, 0, 1), (std::array<Real, 3>{1, 0, 0}));
}

/// Error of u' = i u at t = 2 with n pairs of steps, the second 1.5 times the first; the first two
/// steps exact.
Real error(int n) {
  using Complex = std::complex<Real>;
  const Real pair = 2.0 / n;
  Complex u = 1, last = 0, before = 0;
  Real dt_old = 0, dt_before = 0, t = 0;
  const auto exact = [](Real at) { return std::exp(Complex(0, at)); };
  for (int i = 0; i < 2 * n; ++i) {
    const Real dt = i % 2 == 0 ? 0.4 * pair : 0.6 * pair;
    const Complex now = Complex(0, 1) * u;
    const auto w = adams_bashforth(dt, dt_old, dt_before, 1);
    t += dt;
    u = i < 2 ? exact(t) : u + dt * (w[0] * now + w[1] * last + w[2] * before);
    before = last, last = now, dt_before = dt_old, dt_old = dt;
  }
  return std::abs(u - exact(t));
}

// Between line and parabola: exact for lines, a part of the way for t^2.
TEST(AdamsBashforth, PartOfTheParabola) {
  for (int n = 0; n <= 1; ++n)
    EXPECT_NEAR(weighted(n, 0.4, 0.3, 0.2, 0.25), std::pow(0.4, n) / (n + 1), 1e-15);
  const Real line = weighted(2, 0.4, 0.3, 0.2, 0), parabola = weighted(2, 0.4, 0.3, 0.2, 1);
  EXPECT_NEAR(weighted(2, 0.4, 0.3, 0.2, 0.25), line + 0.25 * (parabola - line), 1e-15);
}

TEST(AdamsBashforth, ThirdOrderWithUnevenSteps) {
  const Real order = std::log2(error(40) / error(80));
  EXPECT_GT(order, 2.8);
  EXPECT_LT(error(80), 1e-5);
}

}  // namespace
}  // namespace fsi::flow
