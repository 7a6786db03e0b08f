#include "libfsi/geometry/simplex.hpp"

#include <gtest/gtest.h>

#include <random>

namespace fsi::geometry {
namespace {

template <std::size_t n>
std::array<Real, n> random_values(std::mt19937& random) {
  std::uniform_real_distribution<Real> any(-1, 1);
  std::array<Real, n> value{};
  for (Real& v : value) v = any(random);
  return value;
}

TEST(Simplex, KnownFractions) {
  EXPECT_EQ(negative_fraction(std::array<Real, 3>{1, 2, 3}), 0);
  EXPECT_EQ(negative_fraction(std::array<Real, 3>{-1, -2, -3}), 1);
  EXPECT_EQ(negative_fraction(std::array<Real, 3>{0, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(negative_fraction(std::array<Real, 3>{-1, 1, 1}), 0.25);
  EXPECT_DOUBLE_EQ(negative_fraction(std::array<Real, 3>{-1, 1, -1}), 0.75);
  EXPECT_DOUBLE_EQ(negative_fraction(std::array<Real, 3>{-1, 0, 1}), 0.5);
  EXPECT_DOUBLE_EQ(negative_fraction(std::array<Real, 4>{1, 1, -1, 1}), 0.125);
  EXPECT_DOUBLE_EQ(negative_fraction(std::array<Real, 4>{-1, 1, -1, -1}), 0.875);
  EXPECT_DOUBLE_EQ(negative_fraction(std::array<Real, 4>{-1, 1, -1, 1}), 0.5);
}

TEST(Simplex, BothSidesFillIt) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    auto three = random_values<3>(random);
    auto four = random_values<4>(random);
    const Real inside = negative_fraction(three), within = negative_fraction(four);
    for (Real& v : three) v = -v;
    for (Real& v : four) v = -v;
    EXPECT_NEAR(inside + negative_fraction(three), 1, 4e-16);
    EXPECT_NEAR(within + negative_fraction(four), 1, 4e-16);
  }
}

TEST(Simplex, FractionIsItsDivisionsSum) {
  // Cutting at the middle of an edge changes nothing: the function stays the same linear one.
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const auto v = random_values<4>(random);
    for (const auto& [a, b] : tetrahedron_edges) {
      auto left = v, right = v;
      left[a] = right[b] = (v[a] + v[b]) / 2;
      EXPECT_NEAR(negative_fraction(v), (negative_fraction(left) + negative_fraction(right)) / 2,
                  1e-15);
    }
  }
}

TEST(Simplex, TinyPartsKeepTheirDigits) {
  const Real e = 1e-6;  // one corner below zero by e: (e / (1 + e))^3
  EXPECT_NEAR(negative_fraction(std::array<Real, 4>{-e, 1, 1, 1}) / std::pow(e / (1 + e), 3), 1,
              1e-14);
}

TEST(Simplex, SectionLiesOnTheZeroSet) {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const auto v = random_values<4>(random);
    int negative = 0;
    for (const Real value : v) negative += value < 0;
    const Section cut = section(v);
    EXPECT_EQ(cut.n, negative == 2 ? 4 : negative % 4 == 0 ? 0 : 3);
    for (int k = 0; k < cut.n; ++k) {
      const Crossing& c = cut.at[static_cast<std::size_t>(k)];
      EXPECT_NEAR((1 - c.s) * v[c.from] + c.s * v[c.to], 0, 1e-15);
      // Neighbours in the polygon share a face of the tetrahedron: three corners between them.
      const Crossing& d = cut.at[static_cast<std::size_t>((k + 1) % cut.n)];
      EXPECT_TRUE(c.from == d.from || c.to == d.to);
    }
  }
}

/// Distance to the unit sphere on the corners and edge middles of a simplex.
template <std::size_t n, std::size_t m>
Real measured(const std::array<Vec3, n>& x,
              const std::array<std::array<std::size_t, 2>, m>& edges) {
  std::array<Real, n> corner{};
  std::array<Real, m> middle{};
  for (std::size_t i = 0; i < n; ++i) corner[i] = norm(x[i]) - 1;
  for (std::size_t e = 0; e < m; ++e) middle[e] = norm((x[edges[e][0]] + x[edges[e][1]]) / 2) - 1;
  return negative_measure(x, corner, middle);
}

/// The same by repeated bisection of every edge 0-1 in turn (corners are cycled).
template <std::size_t n, std::size_t m>
Real bisected(std::array<Vec3, n> x, const std::array<std::array<std::size_t, 2>, m>& edges,
              int depth) {
  if (depth == 0) return measured(x, edges);
  std::size_t a = 0, b = 1;
  for (const auto& [i, j] : edges) {
    if (norm2(x[i] - x[j]) > norm2(x[a] - x[b])) a = i, b = j;
  }
  auto left = x, right = x;
  left[a] = right[b] = (x[a] + x[b]) / 2;
  return bisected(left, edges, depth - 1) + bisected(right, edges, depth - 1);
}

TEST(Simplex, CurvedSurfaceConvergesFast) {
  // Sphere (circle) through a tetrahedron (triangle) of size h about the point (0.6, 0.8, 0).
  const Vec3 at{0.6, 0.8, 0};
  Real before3 = 0, before2 = 0;
  for (const Real h : {0.2, 0.1, 0.05}) {
    const auto p = [&](Real x, Real y, Real z) { return at + h * Vec3{x, y, z}; };
    const Tetrahedron tet{p(-0.5, -0.4, -0.3), p(0.6, -0.3, -0.2), p(0.1, 0.6, -0.4),
                          p(0.05, 0.1, 0.7)};
    const Triangle tri{p(-0.5, -0.4, 0), p(0.6, -0.3, 0), p(0.1, 0.6, 0)};
    const Real error3 =
        std::abs(measured(tet, tetrahedron_edges) / bisected(tet, tetrahedron_edges, 12) - 1);
    const Real error2 =
        std::abs(measured(tri, triangle_edges) / bisected(tri, triangle_edges, 10) - 1);
    EXPECT_LT(error3, 0.25 * h * h);
    EXPECT_LT(error2, 0.025 * h * h);
    if (before3 > 0) {
      EXPECT_GT(std::log2(before3 / error3), 1.9);
      EXPECT_GT(std::log2(before2 / error2), 1.9);
    }
    before3 = error3, before2 = error2;
  }
}

}  // namespace
}  // namespace fsi::geometry
