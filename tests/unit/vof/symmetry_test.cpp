#include "libfsi/vof/symmetry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::vof {
namespace {

CuttingPlanes cut(const Mesh& mesh, const shapes::Shape& shape, const std::vector<Patch>& mirrors) {
  return cutting_planes([&shape](const Vec3& x) { return shape(x); }, mesh, mirrors);
}

GlobalIndex count(const CuttingPlanes& c) {
  return global_sum(static_cast<GlobalIndex>(std::ranges::count(c.faces, 1)));
}
GlobalIndex count_of(const Patch& patch) { return global_sum(patch.end - patch.begin); }

/// One patch of the faces of two that follow each other.
Patch joined(const Patch& a, const Patch& b) {
  Patch both = a;
  both.begin = std::min(a.begin, b.begin), both.end = std::max(a.end, b.end);
  EXPECT_EQ(both.end - both.begin, a.end - a.begin + b.end - b.begin);
  return both;
}

// The planes are found by their faces, whatever patches these are of.
TEST(CuttingPlanes, OfOnePatchOrTwo) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}});
  const Patch left = mesh.patch("left"), right = mesh.patch("right"), bottom = mesh.patch("bottom"),
              top = mesh.patch("top");
  const shapes::Shape corner = shapes::sphere(0.4),
                      between = shapes::translate(shapes::sphere(0.6), {0.5, 0.5, 0});
  for (const CuttingPlanes& c : {cut(mesh, corner, {left, right, bottom, top}),
                                 cut(mesh, corner, {joined(left, right), joined(bottom, top)})}) {
    EXPECT_FALSE(c.odd);
    ASSERT_EQ(c.planes.size(), 2U);
    for (const geometry::Mirror& m : c.planes) EXPECT_NEAR(norm(m.foot({0, 0, 0})), 0, 1e-14);
    EXPECT_EQ(count(c), count_of(left) + count_of(bottom))
        << "whole planes, not what is cut of them";
  }
  for (const CuttingPlanes& c :
       {cut(mesh, between, {left, right}), cut(mesh, between, {joined(left, right)})}) {
    EXPECT_TRUE(c.odd) << "parallel planes give images without end";
    EXPECT_TRUE(c.planes.empty());
    EXPECT_EQ(count(c), count_of(left) + count_of(right)) << "the map goes on beyond each";
  }
  // what touches is not cut
  const shapes::Shape touching = shapes::translate(shapes::sphere(0.25), {0.25, 0.5, 0});
  const CuttingPlanes none = cut(mesh, touching, {left, right, bottom, top});
  EXPECT_FALSE(none.odd);
  EXPECT_TRUE(none.planes.empty());
  EXPECT_EQ(count(none), 0) << "its map does not go on beyond the plane";
}

TEST(CuttingPlanes, ACurvedPatchIsOdd) {
  const auto bent = [](const Vec3& x) { return Vec3{x.x, x.y + 0.1 * x.x * x.x, x.z}; };
  const Mesh mesh = test::read_box({.n = {16, 16, 0}, .moved = bent});
  const CuttingPlanes c =
      cut(mesh, shapes::translate(shapes::sphere(0.3), {0.5, 0, 0}), {mesh.patch("bottom")});
  EXPECT_TRUE(c.odd);
  EXPECT_EQ(count(c), 0);
  const CuttingPlanes of_one =
      cut(mesh, shapes::translate(shapes::sphere(0.02), {0.53, 0.03, 0}), {mesh.patch("bottom")});
  EXPECT_TRUE(of_one.odd) << "one facet of it";
}

// What the digits of a mesh file leave does not make a plane curved, nor two planes oblique.
TEST(CuttingPlanes, AreTakenDespiteRounding) {
  const auto rough = [](const Vec3& x) {
    return x + 1e-6 * Vec3{std::sin(97 * x.y), std::sin(89 * x.x), 0};
  };
  const Mesh mesh = test::read_box({.n = {16, 16, 0}, .moved = rough});
  const CuttingPlanes c =
      cut(mesh, shapes::sphere(0.4), {mesh.patch("bottom"), mesh.patch("left")});
  EXPECT_FALSE(c.odd);
  EXPECT_EQ(c.planes.size(), 2U);
  EXPECT_EQ(count(c), count_of(mesh.patch("bottom")) + count_of(mesh.patch("left")));
}

// Planes of 3-D at 90 and at 60 degrees.
TEST(CuttingPlanes, ObliqueOnesAreOdd) {
  const auto leaning = [](const Vec3& x) { return Vec3{x.x + 0.577 * x.y, x.y, x.z}; };
  for (const bool oblique : {false, true}) {
    test::BoxFile box{.n = {8, 8, 8}};
    if (oblique) box.moved = leaning;
    const Mesh mesh = test::read_box(box);
    const CuttingPlanes c = cut(mesh, shapes::sphere(0.4),
                                {mesh.patch("left"), mesh.patch("bottom"), mesh.patch("back")});
    EXPECT_EQ(c.odd, oblique);
    EXPECT_EQ(c.planes.size(), oblique ? 0U : 3U);
    EXPECT_EQ(count(c), 3 * 64);
  }
}

}  // namespace
}  // namespace fsi::vof
