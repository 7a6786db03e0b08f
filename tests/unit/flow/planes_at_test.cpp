#include "libfsi/flow/planes_at.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

}  // namespace
}  // namespace fsi
