#include "libfsi/analysis/surface.hpp"

#include <gtest/gtest.h>

#include "libfsi/analysis/orientation.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/vof/fill.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::analysis {
namespace {

using namespace shapes;

const Vec3 centre{0.513, 0.497, 0.488};
const Vec3 centre_2d{0.513, 0.497, 0};

Surface surface_of(const Mesh& mesh, const Shape& shape, const Vec3& about) {
  CellField<Real> alpha(mesh);
  vof::fill(alpha, mesh, shape, {}, {1e-4, 0, 4});
  return isosurface(alpha, mesh, about);
}

/// Sum of the area vectors (normals times length in 2-D): zero where the surface is closed.
Real gap(const Surface& s) {
  Sum x, y, z;
  for (Index k = 0; k < s.size(); ++k) {
    const Vec3* p = s.facet(k);
    const Vec3 n = s.dim == 2 ? Vec3{p[1].y - p[0].y, p[0].x - p[1].x, 0}
                              : cross(p[1] - p[0], p[2] - p[0]) / 2;
    x.add(n.x), y.add(n.y), z.add(n.z);
  }
  return norm({x.total(), y.total(), z.total()});
}

/// Farthest point of the surface from the true one.
Real distance(const Surface& s, const Shape& shape) {
  Real most = 0;
  for (const Vec3& x : s.points) most = std::max(most, std::abs(shape(x)));
  return global_max(most);
}

TEST(Surface, DiscConverges) {
  for (const bool simplex : {false, true}) {
    const Shape shape = translate(sphere(0.3), centre_2d);
    Real before = 0;
    for (const Index n : {16, 32, 64}) {
      const Mesh mesh = test::read_box({{n, n, 0}, {1, 1, 1}, simplex});
      const Surface s = surface_of(mesh, shape, centre_2d);
      EXPECT_LE(gap(s), 1e-14);
      EXPECT_NEAR(area(s), 2 * pi * 0.3, 0.02);
      EXPECT_LE(distance(s, shape), 0.11 / n);
      const Real error = 1 - enclosed(s) / disc_area(0.3);
      if (n > 16) {
        EXPECT_GT(std::log2(before / error), 1.9);
      }
      before = error;
    }
  }
}

TEST(Surface, SphereIsClosedAndNear) {
  const Shape shape = translate(sphere(0.3), centre);
  for (const bool simplex : {false, true}) {
    Real before = 0;
    for (const Index n : {10, 20}) {
      const Mesh mesh = test::read_box({{n, n, n}, {1, 1, 1}, simplex});
      const Surface s = surface_of(mesh, shape, centre);
      EXPECT_LE(gap(s), 1e-14);
      EXPECT_LE(distance(s, shape), 0.26 / n);
      const Real error = 1 - enclosed(s) / sphere_volume(0.3);
      if (n > 10) {
        EXPECT_GT(std::log2(before / error), 1.9);
      }
      before = error;
    }
  }
}

TEST(Surface, InOnePieceAcrossASeam) {
  // Moved by a whole number of cells, once inside the mesh and once over two seams.
  const Vec3 moved{9.0 / 16, 0, 8.0 / 16};
  for (const bool simplex : {false, true}) {
    const Mesh mesh =
        test::read_box({{16, 16, 16}, {1, 1, 1}, simplex, {"left", "right", "back", "front"}});
    const Surface inside = surface_of(mesh, translate(sphere(0.3), centre), centre);
    const Surface across = surface_of(mesh, translate(sphere(0.3), centre + moved), centre + moved);
    EXPECT_LE(gap(across), 1e-14);
    EXPECT_NEAR(area(across), area(inside), 1e-6);
    EXPECT_NEAR(enclosed(across), enclosed(inside), 1e-6);
    EXPECT_LE(distance(across, translate(sphere(0.3), centre + moved)), 0.2 / 16);
    EXPECT_NEAR(orientation(across, centre + moved).value[2], orientation(inside, centre).value[2],
                1e-6);
  }
}

TEST(Surface, PlaneAlongTheMeshIsExact) {
  const Mesh mesh = test::read_box({{8, 8, 8}});
  const Shape slab = translate(box({0.61, infinity, infinity}), {0, 0, 0});
  const Surface s = surface_of(mesh, slab, centre);
  EXPECT_NEAR(area(s), 1, 1e-12);
  EXPECT_LE(distance(s, slab), 1e-12);
}

TEST(Surface, OrientationOfATorus) {
  const Mesh mesh = test::read_box({{32, 32, 32}});
  for (const Real degrees : {0.0, 30.0, 90.0}) {
    const Real psi = degrees * pi / 180;
    const Shape shape = translate(rotate(torus(0.3, 0.1), {0, 0, 1}, psi), centre);
    const Surface s = surface_of(mesh, shape, centre);
    const Orientation o = orientation(s, centre);
    EXPECT_NEAR(angle_to_x(o.n), degrees, 0.01);
    // r^2 / 2 along the axis, R^2 / 2 + 3 r^2 / 4 across; the surface of a tube three cells wide
    // lies 0.08 cells inside.
    EXPECT_NEAR(o.value[0], 0.005, 0.06 * 0.005);
    EXPECT_NEAR(o.value[1], 0.0525, 0.015 * 0.0525);
    EXPECT_NEAR(o.value[2], 0.0525, 0.015 * 0.0525);
    const Vec3 axis{std::cos(psi), std::sin(psi), 0};
    EXPECT_LE(norm(cross(o.n, axis)), 1e-3);
    EXPECT_GT(dot(orientation(s, centre, {.n = -axis}).n, -axis), 0.99);
  }
}

TEST(Surface, OrientationOfAnEllipse) {
  const Mesh mesh = test::read_box({{40, 40, 0}});
  const Shape shape =
      translate(rotate(ellipsoid({0.15, 0.35, infinity}), {0, 0, 1}, 0.5), centre_2d);
  const Orientation o = orientation(surface_of(mesh, shape, centre_2d), centre_2d);
  EXPECT_NEAR(angle_to_x(o.n), 0.5 * 180 / pi, 0.2);
  EXPECT_EQ(o.n.z, 0);
  EXPECT_LE(std::abs(dot(o.n, o.longest)), 1e-12);
  EXPECT_EQ(o.longest.z, 0);
}

TEST(Surface, LongestDirectionOfAnEgg) {
  const Mesh mesh = test::read_box({{32, 32, 32}});
  const Real psi = 0.5;
  const Shape shape = translate(rotate(ellipsoid({0.35, 0.15, 0.2}), {0, 0, 1}, psi), centre);
  const Surface s = surface_of(mesh, shape, centre);
  const Orientation o = orientation(s, centre);
  const Vec3 axis{std::cos(psi), std::sin(psi), 0}, short_axis{-std::sin(psi), std::cos(psi), 0};
  EXPECT_LE(norm(cross(o.longest, axis)), 1e-3);
  EXPECT_LE(norm(cross(o.n, short_axis)), 1e-3);
  EXPECT_LT(dot(orientation(s, centre, {.longest = -axis}).longest, axis), -0.99);
}

TEST(Orientation, TurnsAreAddedUpPastNinetyDegrees) {
  const auto line = [](Real degrees) {
    return Vec3{std::cos(degrees * pi / 180), std::sin(degrees * pi / 180), 0};
  };
  Real turned = 0;
  for (int i = 0; i < 20; ++i) turned += turn_about_z(line(17 * i), -line(17 * (i + 1)));
  EXPECT_NEAR(turned, 340, 1e-11);
  EXPECT_NEAR(turn_about_z(line(10), line(-30)), -40, 1e-12);
  EXPECT_EQ(turn_about_z({0, 0, 1}, line(30)), 0);
}

TEST(Surface, NoneWithoutSolid) {
  const Mesh mesh = test::read_box({{4, 4, 4}});
  const Surface s = isosurface(CellField<Real>(mesh), mesh, {});
  EXPECT_EQ(area(s), 0);
  EXPECT_EQ(orientation(s, {}).n, Vec3{});
}

}  // namespace
}  // namespace fsi::analysis
