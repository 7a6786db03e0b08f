#include "libfsi/shapes/shapes.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "libfsi/core/error.hpp"

namespace fsi::shapes {
namespace {

Vec3 random_point(std::mt19937& random, Real half) {
  std::uniform_real_distribution<Real> any(-half, half);
  const Real x = any(random), y = any(random), z = any(random);
  return {x, y, z};
}

Vec3 gradient(const Shape& shape, const Vec3& p) {
  constexpr Real h = 1e-6;
  Vec3 g;
  for (int i = 0; i < 3; ++i) {
    Vec3 e;
    e[i] = h;
    g[i] = (shape(p + e) - shape(p - e)) / (2 * h);
  }
  return g;
}

std::map<std::string, Shape> all_shapes() {
  return {{"sphere", sphere(0.7)},
          {"oblate", ellipsoid({0.3, 0.8, 0.8})},
          {"prolate", ellipsoid({0.9, 0.4, 0.4})},
          {"ellipsoid", ellipsoid({0.9, 0.2, 0.5})},
          {"elliptic cylinder", ellipsoid({0.9, 0.4, infinity})},
          {"cylinder", cylinder(0.6)},
          {"disk", disk(0.8, 0.3)},
          {"torus", torus(0.7, 0.25)},
          {"capsule", capsule(0.3, 0.9)},
          {"box", box({0.5, 1.1, 0.8})},
          {"slab", box({0.5, infinity, infinity})}};
}

TEST(Shapes, AreDistances) {
  // A distance has slope one, its foot point x - f grad f lies on the surface and the segment to it
  // points along the gradient.
  std::mt19937 random(1);
  for (const auto& [name, shape] : all_shapes()) {
    int off = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = random_point(random, 1.3), g = gradient(shape, p);
      if (std::abs(norm(g) - 1) > 1e-6 || std::abs(shape(p - shape(p) * g)) > 1e-8) ++off;
    }
    EXPECT_LE(off, 2) << name;  // a point within 1e-6 of the medial surface
  }
}

TEST(Shapes, AreNowhereSteeperThanOne) {
  std::mt19937 random(2);
  for (const auto& [name, shape] : all_shapes()) {
    for (int i = 0; i < 2000; ++i) {
      const Vec3 a = random_point(random, 1.3), b = a + random_point(random, 0.05);
      EXPECT_LE(std::abs(shape(a) - shape(b)), norm(a - b) * (1 + 1e-12)) << name;
    }
  }
}

TEST(Shapes, AgreeWithTheirEquations) {
  EXPECT_DOUBLE_EQ(sphere(2)({0, 3, 0}), 1);
  EXPECT_DOUBLE_EQ(torus(3, 1)({0, 3, 0}), -1);
  EXPECT_DOUBLE_EQ(torus(3, 1)({2, 0, 3}), 1);
  EXPECT_DOUBLE_EQ(torus(3, 1)({0, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(disk(2, 1)({0, 0, 0}), -0.5);
  EXPECT_DOUBLE_EQ(disk(2, 1)({3.5, 0, 6}), 5);
  EXPECT_DOUBLE_EQ(cylinder(2)({100, 0, 1}), -1);
  EXPECT_DOUBLE_EQ(capsule(1, 2)({4, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(box({2, 4, 6})({0, 0, 0}), -1);
  EXPECT_DOUBLE_EQ(box({2, 4, 6})({1 + 2, 2 + 3, 3 + 6}), 7);
}

TEST(Shapes, EllipsoidOnItsAxesAndPlanes) {
  const Shape e = ellipsoid({3, 1, 2});
  EXPECT_DOUBLE_EQ(e({0, 0, 0}), -1);
  EXPECT_DOUBLE_EQ(e({5, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(e({0, 0, -2.5}), 0.5);
  EXPECT_DOUBLE_EQ(e({0, 0.25, 0}), -0.75);
  // Between the foci the nearest point is off the axis: distance b sqrt(1 - x^2/(a^2 - b^2)).
  EXPECT_NEAR(ellipsoid({3, 1, 1})({2, 0, 0}), -std::sqrt(1 - 4.0 / 8), 1e-14);
  EXPECT_NEAR(ellipsoid({3, 1, 1})({2, 1e-13, 0}), -std::sqrt(1 - 4.0 / 8), 1e-12);
  EXPECT_NEAR(ellipsoid({2, 2, 2})({1, 1, 1}), std::sqrt(3.0) - 2, 1e-14);
  EXPECT_NEAR(ellipsoid({1, 1e-3, 1})({0, 0.5, 0}), 0.499, 1e-14);
}

TEST(Shapes, MovesActOnTheBody) {
  const Real angle = pi / 6;
  const Shape turned = rotate(disk(0.5, 0.1), {0, 0, 1}, angle);
  const Vec3 axis{std::cos(angle), std::sin(angle), 0};
  EXPECT_NEAR(turned(2 * axis), 1.95, 1e-14);
  const Shape aligned = align(disk(0.5, 0.1), 7 * axis);
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = random_point(random, 1);
    EXPECT_NEAR(turned(p), aligned(p), 1e-14);
  }
  EXPECT_NEAR(align(capsule(1, 2), {-1, 0, 0})({3, 0, 0}), 1, 1e-15);
  EXPECT_NEAR(align(cylinder(1), {0, 0, 1})({2, 0, 50}), 1, 1e-13);
  EXPECT_DOUBLE_EQ(translate(sphere(1), {1, 2, 3})({1, 2, 5}), 1);
  const Shape two = unite({sphere(1), translate(sphere(1), {5, 0, 0})});
  EXPECT_DOUBLE_EQ(two({5, 0, 0}), -1);
  EXPECT_DOUBLE_EQ(two({2.5, 0, 0}), 1.5);
}

TEST(Shapes, VolumesAgreeWithCounting) {
  // Midpoint count on a fine grid, the bodies turned and moved off its symmetries.
  constexpr int n = 100;
  const auto counted = [](const Shape& straight) {
    const Shape shape = translate(rotate(straight, {1, 2, 3}, 0.7), {0.013, 0.007, 0.003});
    GlobalIndex inside = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k)
          inside += shape(Vec3{i + 0.5, j + 0.5, k + 0.5} * (2.0 / n) - Vec3{1, 1, 1}) < 0;
    return static_cast<Real>(inside) * 8 / (n * n * n);
  };
  EXPECT_NEAR(counted(sphere(0.9)) / sphere_volume(0.9), 1, 1e-3);
  EXPECT_NEAR(counted(ellipsoid({0.9, 0.5, 0.7})) / ellipsoid_volume({0.9, 0.5, 0.7}), 1, 1e-3);
  EXPECT_NEAR(counted(disk(0.8, 0.7)) / cylinder_volume(0.8, 0.7), 1, 1e-3);
  EXPECT_NEAR(counted(torus(0.6, 0.3)) / torus_volume(0.6, 0.3), 1, 1e-3);
  EXPECT_NEAR(counted(capsule(0.4, 0.9)) / capsule_volume(0.4, 0.9), 1, 1e-3);
  EXPECT_NEAR(counted(box({1, 0.6, 1.5})) / box_volume({1, 0.6, 1.5}), 1, 1e-3);
}

TEST(Shapes, RefuseImpossibleSizes) {
  EXPECT_THROW(sphere(0), Error);
  EXPECT_THROW(sphere(std::nan("")), Error);
  EXPECT_THROW(torus(0.1, 0.3), Error);
  EXPECT_THROW(ellipsoid({1, -1, 1}), Error);
  EXPECT_THROW(ellipsoid({infinity, infinity, infinity}), Error);
  EXPECT_THROW(rotate(sphere(1), {0, 0, 0}, 1), Error);
  EXPECT_THROW(unite({}), Error);
}

}  // namespace
}  // namespace fsi::shapes
