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
