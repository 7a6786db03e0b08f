#include "libfsi/core/eigen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace fsi {
namespace {

Real size(const SymTensor& t) {
  return std::sqrt(t.xx * t.xx + t.yy * t.yy + t.zz * t.zz +
                   2 * (t.xy * t.xy + t.xz * t.xz + t.yz * t.yz));
}

void expect_solves(const SymTensor& t) {
  const Eigen e = eigen(t);
  const Real tolerance = 1e-13 * size(t);
  EXPECT_LE(e.value[0], e.value[1]);
  EXPECT_LE(e.value[1], e.value[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LE(norm(dot(t, e.vector[i]) - e.value[i] * e.vector[i]), tolerance);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(dot(e.vector[i], e.vector[j]), i == j ? 1 : 0, 1e-14);
    }
  }
  EXPECT_NEAR(dot(cross(e.vector[0], e.vector[1]), e.vector[2]), 1, 1e-14);
  EXPECT_NEAR(e.value[0] + e.value[1] + e.value[2], trace(t), tolerance);
}

/// R diag(a) R^T with a random rotation R from a random unit quaternion.
SymTensor with_values(const Vec3& a, std::mt19937& random) {
  std::normal_distribution<Real> normal;
  Real w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  const Real s = 1 / std::sqrt(w * w + x * x + y * y + z * z);
  w *= s, x *= s, y *= s, z *= s;
  const Vec3 rows[3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                        {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                        {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  const auto item = [&](int i, int j) {
    return rows[i].x * a.x * rows[j].x + rows[i].y * a.y * rows[j].y + rows[i].z * a.z * rows[j].z;
  };
  return {item(0, 0), item(0, 1), item(0, 2), item(1, 1), item(1, 2), item(2, 2)};
}

TEST(Eigen, RandomTensors) {
  std::mt19937 random(1);
  std::uniform_real_distribution<Real> any(-1, 1), power(-8, 8);
  for (int i = 0; i < 5000; ++i) {
    const Real s = std::pow(10, power(random));
    expect_solves({s * any(random), s * any(random), s * any(random), s * any(random),
                   s * any(random), s * any(random)});
  }
}

TEST(Eigen, RepeatedAndNearlyEqualValues) {
  std::mt19937 random(2);
  for (const Real gap : {0.0, 1e-15, 1e-12, 1e-8, 1e-4}) {
    for (int i = 0; i < 200; ++i) {
      for (const Vec3& values : {Vec3{1, 1 + gap, 3}, {1, 3, 3 + gap}, {2, 2 + gap, 2 - gap}}) {
        const SymTensor t = with_values(values, random);
        expect_solves(t);
        std::array<Real, 3> expected{values.x, values.y, values.z};
        std::ranges::sort(expected);
        const Eigen e = eigen(t);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(e.value[k], expected[k], 1e-14);
      }
    }
  }
}

TEST(Eigen, WidelySpreadAndDegenerateTensors) {
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) expect_solves(with_values({1e-6, 1, 1e6}, random));
  expect_solves({});
  expect_solves(identity());
  expect_solves({0, 1, 0, 0, 0, 0});
  expect_solves({1, 1, 1, 1, 1, 1});
  expect_solves({1, 1e-200, 0, 2, 0, 3});
}

TEST(Eigen, PlaneTensorKeepsTheThirdDirection) {
  const Eigen e = eigen({2, 1, 0, 2, 0, 5});
  EXPECT_NEAR(e.value[0], 1, 1e-15);
  EXPECT_NEAR(e.value[1], 3, 1e-15);
  EXPECT_EQ(e.value[2], 5);
  EXPECT_NEAR(std::abs(e.vector[2].z), 1, 1e-15);
}

TEST(Eigen, NonFiniteInputGivesNoNumbers) {
  for (const Real bad : {std::nan(""), std::numeric_limits<Real>::infinity()})
    for (int i = 0; i < 6; ++i) {
      SymTensor t{1, 0.5, 0, 2, 0, 3};
      *std::array{&t.xx, &t.xy, &t.xz, &t.yy, &t.yz, &t.zz}[static_cast<std::size_t>(i)] = bad;
      for (const Real value : eigen(t).value) EXPECT_TRUE(std::isnan(value));
    }
}

}  // namespace
}  // namespace fsi
