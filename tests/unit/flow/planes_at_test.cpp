#include "libfsi/flow/planes_at.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// The planes of symmetry of a half and of a quarter, and the diameter of the whole opening.
TEST(PlanesAt, AreThoseThatMeetTheOpening) {
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {3, 4, 4}, .length = {3, 1, 2}, .simplex = simplex});
    const Patch &left = mesh.patch("left"), &bottom = mesh.patch("bottom"),
                &top = mesh.patch("top"), &back = mesh.patch("back"), &right = mesh.patch("right");
    const auto diameter = [](Real area) { return std::sqrt(4 * area / std::numbers::pi); };
    EXPECT_TRUE(flow::planes_at(left, {}, mesh).empty());
    const auto half = flow::planes_at(left, {bottom}, mesh);
    ASSERT_EQ(half.size(), 1U);
    EXPECT_LT(norm(half[0].n - Vec3{0, -1, 0}), 1e-12);
    EXPECT_NEAR(half[0].x.y, 0, 1e-12);
    EXPECT_NEAR(flow::whole_diameter(left, {bottom}, mesh), diameter(4), 1e-12);
    EXPECT_EQ(flow::planes_at(left, {bottom, back}, mesh).size(), 2U);
    EXPECT_NEAR(flow::whole_diameter(left, {bottom, back}, mesh), diameter(8), 1e-12);
    // Two that face each other have images without end; the last does not meet the opening.
    EXPECT_TRUE(flow::planes_at(left, {bottom, top}, mesh).empty());
    EXPECT_TRUE(flow::planes_at(left, {right}, mesh).empty());
  }
}

// A quarter of a vessel, turned about its axis.
TEST(PlanesAt, DoNotDependOnTheTurnOfTheMesh) {
  for (const Real tangent : {0.0, 0.3, -0.4, 1.0}) {
    const Real c = 1 / std::hypot(1, tangent), s = tangent * c;
    const auto turned = [=](const Vec3& x) {
      return Vec3{x.x, c * x.y - s * x.z, s * x.y + c * x.z};
    };
    const Mesh mesh = test::read_box({.n = {3, 4, 4}, .length = {3, 1, 2}, .moved = turned});
    const std::vector<Patch> planes{mesh.patch("bottom"), mesh.patch("back")};
    const Patch& left = mesh.patch("left");
    EXPECT_EQ(flow::planes_at(left, planes, mesh).size(), 2U) << tangent;
    EXPECT_NEAR(flow::whole_diameter(left, planes, mesh), std::sqrt(32 / std::numbers::pi), 1e-9)
        << tangent;
  }
}

// In two dimensions opening and plane have one corner in common, whose cells may be on two ranks.
TEST(PlanesAt, DoNotDependOnTheRanks) {
  for (Index nx = 3; nx < 14; ++nx)
    for (Index ny = 3; ny < 14; ++ny) {
      const Vec3 length{static_cast<Real>(nx), static_cast<Real>(ny), 0};
      const Mesh mesh = test::read_box({.n = {nx, ny, 0}, .length = length, .simplex = true});
      for (const char* opening : {"left", "right"})
        for (const char* plane : {"bottom", "top"})
          EXPECT_EQ(flow::planes_at(mesh.patch(opening), {mesh.patch(plane)}, mesh).size(), 1U)
              << nx << ' ' << ny << ' ' << opening << ' ' << plane;
    }
}

}  // namespace
}  // namespace fsi
