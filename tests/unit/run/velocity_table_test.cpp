#include "libfsi/run/velocity_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "libfsi/core/error.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// n x n places on the square of side 1 across x at x = 2, off a lattice by a fifth.
VelocityTable table_of(int n, const std::function<Vec3(const Vec3&)>& u) {
  std::vector<VelocityTable::Row> rows;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 x{2, (i + 0.5 + 0.2 * std::sin(7.0 * j)) / n,
                   (j + 0.5 + 0.2 * std::cos(5.0 * i)) / n};
      rows.push_back({.x = x, .u = u(x)});
    }
  return {"profile.csv", rows};
}

TEST(VelocityTable, IsExactForALinearVelocity) {
  const auto u = [](const Vec3& x) { return Vec3{1 + 2 * x.y - 3 * x.z, x.z, 4 - x.y}; };
  const VelocityTable table = table_of(6, u);
  for (const Vec3& x : {Vec3{2, 0.31, 0.62}, Vec3{2, 0, 0}, Vec3{2, 1, 0.5}})
    EXPECT_LT(norm(table(x) - u(x)), 1e-12);
  // Across the plane of the places it goes on as a constant.
  EXPECT_LT(norm(table({2.1, 0.31, 0.62}) - u({2, 0.31, 0.62})), 1e-12);
}

// The eight nearest of such a table stand in one row.
TEST(VelocityTable, TakesRowsFarApart) {
  std::vector<VelocityTable::Row> rows;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 40; ++j)
      rows.push_back({.x = {0, i / 4.0, j / 39.0}, .u = {1 + 2 * i / 4.0, 0, 0}});
  const VelocityTable table("rows.csv", rows);
  for (const Vec3& x : {Vec3{0, 0.4, 0.5}, Vec3{0, 0.1, 0.01}, Vec3{0, 0.9, 1}})
    EXPECT_LT(norm(table(x) - Vec3{1 + 2 * x.y, 0, 0}), 1e-12);
}

TEST(VelocityTable, IsOfThirdOrder) {
  const auto u = [](const Vec3& x) { return Vec3{std::sin(3 * x.y) * std::cos(2 * x.z), 0, 0}; };
  const auto error = [&](int n) {
    const VelocityTable table = table_of(n, u);
    Real sum = 0;
    for (int i = 0; i < 50; ++i)
      for (int j = 0; j < 50; ++j) {
        const Vec3 x{2, (i + 0.5) / 50, (j + 0.5) / 50};
        sum += norm2(table(x) - u(x)) / 2500;
      }
    return std::sqrt(sum);
  };
  EXPECT_GT(std::log2(error(10) / error(20)), 2.7);
}

// A parabola in a tube that stands obliquely, by eight places, and one between plates by four.
TEST(VelocityTable, IsExactForAParabola) {
  const Vec3 n{0.6, 0.64, 0.48}, a{0.8, -0.48, -0.36}, b{0, 0.6, -0.8}, middle{3, -2, 5};
  const auto u = [&](const Vec3& x) { return (1 - norm2(x - middle)) * n; };
  std::vector<VelocityTable::Row> rows;
  for (int i = 0; i < 8; ++i) {
    const Real r = 0.3 + 0.08 * i, angle = 2.4 * i;
    const Vec3 x = middle + r * std::cos(angle) * a + r * std::sin(angle) * b;
    rows.push_back({.x = x, .u = u(x)});
  }
  const VelocityTable tube("tube.csv", rows);
  for (const Vec3& x : {middle, middle + 0.9 * a, middle - 0.5 * a + 0.7 * b})
    EXPECT_LT(norm(tube(x) - u(x)), 1e-12);
  std::vector<VelocityTable::Row> line;
  for (const Real y : {0.1, 0.3, 0.5, 0.9})
    line.push_back({.x = {0, y, 0}, .u = {y * (1 - y), 0, 0}});
  const VelocityTable slit("slit.csv", line);
  for (const Real y : {0.0, 0.2, 0.77, 1.0}) EXPECT_NEAR(slit({0, y, 0}).x, y * (1 - y), 1e-13);
}

// Two layers of a profile, a thousandth of its width apart, are one.
TEST(VelocityTable, MergesLayers) {
  std::vector<VelocityTable::Row> rows;
  for (const Real x : {0.0, 0.001})
    for (int i = 0; i <= 8; ++i) {
      const Real y = i / 8.0;
      rows.push_back({.x = {x, y, 0}, .u = {y * (1 - y) + x, 0, 0}});
    }
  const VelocityTable table("layers.csv", rows);
  for (const Real y : {0.0, 0.3, 0.9})
    EXPECT_NEAR(table({0, y, 0}).x, y * (1 - y) + 0.0005, 1e-6) << y;
}

// A parabola between plates, in one table for an inlet and an outlet far apart. The line from one
// to the other says nothing of the profile.
TEST(VelocityTable, TakesThePlacesAtAPatch) {
  const Mesh mesh = test::read_box({.n = {4, 8, 1}, .length = {40, 1, 1}});
  std::vector<VelocityTable::Row> rows;
  for (const Real x : {0.0, 40.0})
    for (int i = 0; i <= 8; ++i) {
      const Real y = i / 8.0;
      rows.push_back({.x = {x, y, 0.5}, .u = {y * (1 - y) * (1 + x), 0, 0}});
    }
  for (const Real x : {0.0, 40.0}) {
    VelocityTable table("two.csv", rows);
    EXPECT_EQ(table.fit_to(mesh, mesh.patch(x == 0 ? "left" : "right")), "");
    for (const Real y : {0.0, 0.3, 0.9})
      EXPECT_NEAR(table({x, y, 0.5}).x, y * (1 - y) * (1 + x), 1e-11) << x << ' ' << y;
  }
}

// Across a slot of a hundredth of its width.
TEST(VelocityTable, KnowsTheProfileOfASlot) {
  const Real height = 0.01;
  const Mesh mesh = test::read_box({.n = {2, 40, 6}, .length = {1, 1, height}});
  std::vector<VelocityTable::Row> rows;
  const auto u = [&](const Vec3& x) {
    const Real s = x.z / height;
    return Vec3{s * (1 - s) * (1 + x.y), 0, 0};
  };
  for (int i = 0; i <= 30; ++i)
    for (int j = 0; j <= 8; ++j) {
      const Vec3 x{0, i / 30.0, height * j / 8};
      rows.push_back({.x = x, .u = u(x)});
    }
  VelocityTable table("slot.csv", rows);
  EXPECT_EQ(table.fit_to(mesh, mesh.patch("left")), "");
  for (const Real y : {0.01, 0.52})
    for (const Real s : {0.0, 0.31, 0.5})
      EXPECT_LT(norm(table({0, y, s * height}) - u({0, y, s * height})), 1e-2) << y << ' ' << s;
}

TEST(VelocityTable, RefusesTwoVelocitiesAtOnePlace) {
  EXPECT_THROW(VelocityTable("two.csv", {{.x = {0, 1, 0}, .u = {1, 0, 0}},
                                         {.x = {0, 2, 0}, .u = {1, 0, 0}},
                                         {.x = {0, 1, 0}, .u = {2, 0, 0}}}),
               Error);
}

TEST(VelocityTable, TellsOfAnotherWidth) {
  const Mesh mesh = test::read_box({.n = {4, 4, 4}, .length = {2, 1, 1}});
  const auto told = [&](Real width) {
    std::vector<VelocityTable::Row> rows;
    for (int i = 0; i < 9; ++i)
      rows.push_back({.x = {2, 0.5 + width * (i / 8.0 - 0.5), 0.5}, .u = {1, 0, 0}});
    return VelocityTable("line.csv", rows).fit_to(mesh, mesh.patch("right"));
  };
  EXPECT_EQ(told(1), "");
  EXPECT_EQ(told(0.6), "");
  EXPECT_NE(told(0.3).find("span 0.3, where patch right spans 1"), std::string::npos) << told(0.3);
  EXPECT_NE(told(5), "");
}

TEST(VelocityTable, TellsPlacesOfElsewhere) {
  const VelocityTable in_millimetres = table_of(6, [](const Vec3&) { return Vec3{1, 0, 0}; });
  const auto check = [](VelocityTable table, const Vec3& length) {
    const Mesh mesh = test::read_box({.n = {4, 4, 4}, .length = length});
    table.fit_to(mesh, mesh.patch("right"));
  };
  EXPECT_THROW(check(in_millimetres, {2e3, 1e3, 1e3}), Error);
  EXPECT_THROW(check(in_millimetres, {2, 1e-3, 1e-3}), Error);
  check(in_millimetres, {2, 1, 1});
  std::vector<VelocityTable::Row> line;
  for (int i = 0; i < 9; ++i) line.push_back({.x = {2, 0.1 * (i + 1), 0.5}, .u = {1, 0, 0}});
  check({"line.csv", line}, {2, 1, 1});
  check({"two.csv", {line[3], line[5]}}, {2, 1, 1});
  EXPECT_THROW(VelocityTable("empty.csv", {}), Error);
  const VelocityTable one("one.csv", {{.x = {}, .u = {1, 2, 3}}});
  EXPECT_EQ(one({5, 6, 7}), (Vec3{1, 2, 3}));
}

TEST(VelocityTable, TakesEqualPlacesAndLines) {
  const VelocityTable table("line.csv", {{.x = {0, 0, 0}, .u = {0, 0, 0}},
                                         {.x = {0, 0, 0}, .u = {0, 0, 0}},
                                         {.x = {0, 1, 0}, .u = {2, 0, 0}}});
  EXPECT_LT(norm(table({0, 0.25, 0}) - Vec3{0.5, 0, 0}), 1e-14);
}

}  // namespace
}  // namespace fsi
