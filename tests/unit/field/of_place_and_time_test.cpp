// How long steps may be for what a function gives over place and time.

#include "libfsi/field/of_place_and_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

/// Points of this rank: those of others lie elsewhere on the x axis.
std::vector<Vec3> points() {
  std::vector<Vec3> all;
  for (int i = 0; i < 8; ++i) all.push_back({rank() + i / 8.0, 0, 0});
  return all;
}

TEST(OfPlaceAndTime, AConstantLimitsNoStep) {
  const std::vector<Vec3> all = points();
  const OfPlaceAndTime given([](const Vec3& x, Real) { return Vec3{x.x, 2, 0}; }, all);
  EXPECT_EQ(given.step_of(0, 7), 7);
}

// A sine takes 1/20 of its range, 2, in 0.1 / (2 pi / T) where it is steepest. With a past it takes
// 1/40 in 0.8 of the step before, and the lengths tried are three quarters of each other.
TEST(OfPlaceAndTime, AStepSeesASmallPartOfTheRange) {
  const std::vector<Vec3> all = points();
  constexpr Real T = 0.05;
  const OfPlaceAndTime given(
      [](const Vec3& x, Real t) {
        const bool here = std::abs(x.x - 0.5) < 0.01;  // of rank 0 alone
        return Vec3{5, here ? std::sin(2 * std::numbers::pi / T * t) : 0, 0};
      },
      all);
  const Real steepest = 0.1 * T / (2 * std::numbers::pi);
  for (const Real t : {0.0, 0.013, 0.31}) {
    const Real dt = given.step_of(t, 1);
    EXPECT_GE(dt, 0.75 * 0.625 * steepest) << t;
    EXPECT_LE(dt, T / 15) << t;
  }
  EXPECT_LE(given.step_of(0, 1), steepest * 1.01) << "at the zero it is steepest";
}

TEST(OfPlaceAndTime, AComponentThatHardlyChangesLimitsNothing) {
  const std::vector<Vec3> all = points();
  const OfPlaceAndTime given(
      [](const Vec3&, Real t) {
        return Vec3{t, 1e-3 * std::sin(1000 * t), 0};
      },
      all);
  EXPECT_NEAR(given.step_of(0, 1), 0.05, 0.013);
}

// At t = 0.5 a ramp falls by a part of its value. The steps after it are equal or longer by a
// third.
void follow_jump(Real part) {
  const OfTime saw([&](Real t) { return t < 0.5 ? t : t - 0.5 * part; });
  Real t = 0, before = 0;
  bool jumped = false;
  int steps = 0;
  while (t < 1) {
    const Real dt = step_of(saw, t, 1);
    if (jumped && t < 0.9) {
      EXPECT_LE(dt, 1.34 * before) << t;
    }
    if (t < 0.5 && t + dt >= 0.5) {
      jumped = true;
      EXPECT_LE(dt, 2e-5) << "the jump is one step";
    }
    t += dt, before = dt, ++steps;
  }
  EXPECT_TRUE(jumped);
  EXPECT_LE(steps, 140);
}

TEST(OfPlaceAndTime, StepsGrowSlowlyAfterAJump) {
  for (const Real part : {1.0, 0.5, 0.2, 0.12}) follow_jump(part);
}

// A step over an extreme of a sine would not see it by the values at its ends.
TEST(OfPlaceAndTime, NoStepLeapsOverAnExtreme) {
  constexpr Real T = 0.05;
  const OfTime sine([](Real t) { return std::cos(2 * std::numbers::pi / T * t); });
  int steps = 0;
  for (Real t = 0.2; t < 0.4; ++steps) {
    const Real dt = step_of(sine, t, 1);
    EXPECT_LE(dt, T / 15) << t;
    t += dt;
  }
  EXPECT_LE(steps, 80 * 4);
}

// One at the place 0.125 in 0.1 to 0.3, another at 0.75 in 0.6 to 0.8, hardly less.
TEST(OfPlaceAndTime, PulsesAtDifferentPlacesAreFollowed) {
  const std::vector<Vec3> all = points();
  const auto pulse = [](Real t, Real begin) {
    const bool in = t > begin && t < begin + 0.2;
    return in ? std::sin(std::numbers::pi * (t - begin) / 0.2) : 0;
  };
  const OfPlaceAndTime given(
      [&](const Vec3& x, Real t) {
        if (std::abs(x.x - 0.125) < 0.01) return Vec3{0, pulse(t, 0.1), 0};
        return std::abs(x.x - 0.75) < 0.01 ? Vec3{0.99 * pulse(t, 0.6), 0, 0} : Vec3{};
      },
      all);
  for (const Real t : {0.11, 0.15, 0.61, 0.65}) EXPECT_LT(given.step_of(t, 1), 0.02) << t;
  for (const Real t : {0.0, 0.35}) EXPECT_LT(given.step_of(t, 1), 0.32) << t;
}

}  // namespace
}  // namespace fsi
