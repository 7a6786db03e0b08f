#include "libfsi/analysis/ellipse.hpp"

#include <gtest/gtest.h>

#include <random>

#include "libfsi/shapes/shapes.hpp"

namespace fsi::analysis {
namespace {

using shapes::pi;

/// n points of an ellipse, dealt out to the ranks, moved by a random distance up to `noise`.
PlaneMoments points(const Ellipse& e, int n, Real noise = 0, Real arc = 2 * pi) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> any(-1, 1);
  PlaneMoments moments;
  for (int k = 0; k < n; ++k) {
    const Real t = arc * k / n, a = e.major * std::cos(t), b = e.minor * std::sin(t);
    const Real x = e.x + std::cos(e.angle) * a - std::sin(e.angle) * b + noise * any(random);
    const Real y = e.y + std::sin(e.angle) * a + std::cos(e.angle) * b + noise * any(random);
    if (k % ranks() == rank()) moments.add(x, y, 1);
  }
  return moments;
}

void expect_near(const Ellipse& a, const Ellipse& b, Real tolerance) {
  EXPECT_TRUE(a.found);
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.major, b.major, tolerance);
  EXPECT_NEAR(a.minor, b.minor, tolerance);
  EXPECT_NEAR(std::sin(2 * (a.angle - b.angle)), 0, tolerance);
  EXPECT_GT(std::cos(2 * (a.angle - b.angle)), 0);
}

TEST(Ellipse, ExactPointsAreFoundAgain) {
  const std::array<Ellipse, 3> truth{{{0.3, 0.1, 0.12, 0.08, 0.4, true},
                                      {-2, 5, 3, 1, 2.8, true},
                                      {0, 0, 1e-3, 0.9e-3, -1.2, true}}};
  const auto found =
      PlaneMoments::fit<3>({points(truth[0], 40), points(truth[1], 7), points(truth[2], 100)});
  for (std::size_t k = 0; k < 3; ++k) expect_near(found[k], truth[k], 1e-6 * truth[k].major);
}

TEST(Ellipse, CircleHasAspectOne) {
  const auto found = PlaneMoments::fit<1>({points({0.3, 0, 0.1, 0.1, 0, true}, 30)});
  EXPECT_NEAR(found[0].aspect(), 1, 1e-7);
  EXPECT_NEAR(found[0].major, 0.1, 1e-8);
}

TEST(Ellipse, NoiseAndPartOfTheArc) {
  const Ellipse truth{0.3, 0.1, 0.12, 0.08, 0.4, true};
  expect_near(PlaneMoments::fit<1>({points(truth, 400, 1e-3)})[0], truth, 2e-3);
  expect_near(PlaneMoments::fit<1>({points(truth, 50, 0, pi)})[0], truth, 1e-6);
}

TEST(Ellipse, NoneWhereThereIsNone) {
  PlaneMoments line;
  for (int k = 0; k < 20; ++k) line.add(k, 2 * k + 1, 1);
  const auto found = PlaneMoments::fit<2>({PlaneMoments{}, line});
  EXPECT_FALSE(found[0].found);
  EXPECT_FALSE(found[1].found);
  EXPECT_EQ(found[0].aspect(), 0);
}

}  // namespace
}  // namespace fsi::analysis
