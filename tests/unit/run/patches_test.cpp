#include "libfsi/run/patches.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/core/error.hpp"
#include "libfsi/flow/centre_line.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// A vessel bent to a quarter of a circle of radius 3.
TEST(CentreLine, FollowsTheVessel) {
  test::BoxFile box{.n = {40, 6, 6}, .length = {1, 1, 1}};
  box.moved = [](const Vec3& x) {
    const Real r = 2.5 + x.y, angle = x.x * std::acos(0.0);
    return Vec3{r * std::sin(angle), r * std::cos(angle), x.z};
  };
  const Mesh mesh = test::read_box(box);
  const flow::CentreLine line(mesh, "left", "right");
  const Real length = 3 * std::acos(0.0);
  EXPECT_NEAR(line.length(), length, 0.005 * length);
  for (const Real part : {0.2, 0.5, 0.7}) {
    const auto [x, along] = line.at(part * line.length());
    const Real angle = part * std::acos(0.0);
    EXPECT_NEAR(norm(x - Vec3{3 * std::sin(angle), 3 * std::cos(angle), 0.5}), 0, 0.015) << part;
    EXPECT_NEAR(dot(along, Vec3{std::cos(angle), -std::sin(angle), 0}), 1, 0.01) << part;
  }
  EXPECT_THROW(flow::CentreLine(mesh, "left", "nowhere"), Error);
}

// A vessel that bends to an angle of 0.8 and back: its direction is that of the bends.
TEST(CentreLine, PointsAlongTheVessel) {
  test::BoxFile box{.n = {24, 6, 6}, .length = {1, 1, 1}};
  box.moved = [](const Vec3& x) {
    const Real half = 2.5 * 0.8, way = 2 * half * x.x, back = std::max(way - half, Real{0});
    const Real angle = std::min(way, 2 * half - way) / 2.5, c = std::cos(angle),
               s = std::sin(angle);
    const Vec3 turn{2.5 * std::sin(0.8), 2.5 * (1 - std::cos(0.8)), 0};
    const Vec3 on{2.5 * s, 2.5 * (1 - c), 0};
    return (back > 0 ? 2 * turn - on : on) + Vec3{-(x.y - 0.5) * s, (x.y - 0.5) * c, x.z};
  };
  const Mesh mesh = test::read_box(box);
  const flow::CentreLine line(mesh, "left", "right");
  for (const Real part : {0.1, 0.2, 0.35, 0.8}) {
    const Vec3 along = line.at(part * line.length()).second;
    EXPECT_NEAR(std::atan2(along.y, along.x), 1.6 * std::min(part, 1 - part), 0.05) << part;
  }
}

// In other units of length the line is the same one.
TEST(CentreLine, ScalesWithTheVessel) {
  const auto at_half = [](Real size) {
    test::BoxFile box{.n = {20, 6, 6}, .length = {1, 1, 1}, .simplex = true};
    box.moved = [size](const Vec3& x) { return size * Vec3{3 * x.x, x.y + 0.5 * x.x * x.x, x.z}; };
    const Mesh mesh = test::read_box(box);
    const flow::CentreLine line(mesh, "left", "right");
    return line.at(line.length() / 2).first / size;
  };
  const Vec3 x = at_half(1);
  for (const Real size : {1e-5, 1e6}) EXPECT_LT(norm(at_half(size) - x), 1e-6) << size;
}

}  // namespace
}  // namespace fsi
