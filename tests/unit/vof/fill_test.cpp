#include "libfsi/vof/fill.hpp"

#include <gtest/gtest.h>

#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::vof {
namespace {

using namespace shapes;

const Vec3 solid_centre{0.513, 0.497, 0.488};
const Vec3 centre_2d{0.513, 0.497, 0};

struct Result {
  Real error, estimate, clearance;
};

/// Relative to the exact volume; checks the bounds and the sum on the way.
Result filled(const Mesh& mesh, const Shape& shape, Real exact, const FillAccuracy& accuracy = {}) {
  CellField<Real> alpha(mesh, -1);
  const Filled result = fill(alpha, mesh, shape, {}, accuracy);
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) sum.add(alpha[c] * mesh.V[c]);
  EXPECT_EQ(sum.total(), result.volume);
  for (Index c = 0; c < mesh.n_cells; ++c) {
    EXPECT_GE(alpha[c], 0);
    EXPECT_LE(alpha[c], 1);
  }
  return {std::abs(result.volume / exact - 1), result.estimated_error / exact, result.clearance};
}

TEST(Fill, TellsWhetherAShapeIsADistance) {
  const Mesh mesh = test::read_box({.n = {24, 24, 0}});
  const auto steepest = [&](const Shape& shape) {
    CellField<Real> alpha(mesh);
    return fill(alpha, mesh, shape).steepest;
  };
  const Real r = 0.2;
  const auto from_centre = [](const Vec3& x) { return norm(x - centre_2d); };
  EXPECT_LE(steepest([&](const Vec3& x) { return from_centre(x) - r; }), 1 + 1e-12);
  EXPECT_LE(steepest([&](const Vec3& x) { return 0.05 * (from_centre(x) - r); }), 0.05 + 1e-12);
  // Its slope is 2 r at the surface.
  EXPECT_LE(steepest([&](const Vec3& x) { return norm2(x - centre_2d) - r * r; }), 0.7);
  EXPECT_LE(steepest(translate(ellipsoid({0.3, 0.05, infinity}), centre_2d)), 1 + 1e-12);
  EXPECT_GE(steepest([&](const Vec3& x) { return norm2(x - centre_2d) / (r * r) - 1; }), 8);
  EXPECT_GE(steepest([&](const Vec3& x) { return from_centre(x) < r ? -1.0 : 1.0; }), 8);
}

/// A smooth map of the unit box to itself that leaves its boundary in place.
Vec3 distorted(const Vec3& x) {
  const Real s = std::sin(pi * x.x) * std::sin(pi * x.y);
  return {x.x + 0.06 * s * std::sin(2 * pi * x.y), x.y + 0.06 * s * std::cos(3 * x.x),
          x.z + 0.05 * s * std::sin(pi * x.z)};
}

TEST(Fill, DiscOnQuadsAndTriangles) {
  for (const bool simplex : {false, true}) {
    for (const Index n : {16, 64}) {
      const Mesh mesh = test::read_box({{n, n, 0}, {1, 1, 1}, simplex, {}, distorted});
      const Result r = filled(mesh, translate(sphere(0.2), centre_2d), disc_area(0.2));
      EXPECT_LE(r.error, 1e-6);
      EXPECT_LE(r.error, r.estimate);
      EXPECT_LE(r.estimate, 5e-5);
    }
  }
}

TEST(Fill, TorusAt32CellsPerDiameter) {
  const Mesh mesh = test::read_box({{32, 32, 32}});
  const Shape shape = translate(rotate(torus(0.3, 0.1), {0, 0, 1}, pi / 4), solid_centre);
  const Result r = filled(mesh, shape, torus_volume(0.3, 0.1));
  EXPECT_LE(r.error, 1e-7);
  EXPECT_LE(r.estimate, 3e-6);
}

TEST(Fill, SmoothShapesOnDistortedHexesAndTets) {
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({{14, 14, 14}, {1, 1, 1}, simplex, {}, distorted});
    const Result ball = filled(mesh, translate(sphere(0.3), solid_centre), sphere_volume(0.3));
    EXPECT_LE(ball.error, 1e-6);
    EXPECT_LE(ball.error, ball.estimate);
    if (simplex) continue;
    const Vec3 semi_axes{0.2632, 0.4, 0.2632};
    const Result egg =
        filled(mesh, translate(rotate(ellipsoid(semi_axes), {0, 0, 1}, 0.7), solid_centre),
               ellipsoid_volume(semi_axes));
    EXPECT_LE(egg.error, 1e-6);
  }
}

TEST(Fill, SharpEdgesAreSecondOrderInTheLastDivision) {
  const Mesh mesh = test::read_box({{12, 12, 12}});
  const Shape shape = translate(rotate(disk(0.3545, 0.1772), {0, 0, 1}, pi / 4), solid_centre);
  const Real exact = cylinder_volume(0.3545, 0.1772);
  const Real coarse = filled(mesh, shape, exact, {1e9, 1, 1}).error;
  const Real fine = filled(mesh, shape, exact, {1e9, 3, 3}).error;
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.6);
  const Result r = filled(mesh, shape, exact);
  EXPECT_LE(r.error, 5e-5);
  EXPECT_LE(r.error, r.estimate);
}

TEST(Fill, SmoothSurfacesAreThirdOrderAndBetterInTheLastDivision) {
  const Mesh mesh = test::read_box({{8, 8, 8}});
  const Shape shape = translate(sphere(0.3), solid_centre);
  const Real coarse = filled(mesh, shape, sphere_volume(0.3), {1e9, 0, 0}).error;
  const Real fine = filled(mesh, shape, sphere_volume(0.3), {1e9, 3, 3}).error;
  EXPECT_GT(std::log2(coarse / fine) / 3, 3.2);
}

TEST(Fill, PlanesAreExact) {
  const Mesh mesh = test::read_box({{5, 6, 7}, {1, 1, 1}, true, {}, distorted});
  const Shape half = align(box({1, infinity, infinity}), {1, 2, -0.5});
  // The slab's face at distance 1/2 along its axis is moved to the centre of the box.
  const Vec3 n = Vec3{1, 2, -0.5} / norm({1, 2, -0.5});
  const Result r = filled(mesh, translate(half, Vec3{0.5, 0.5, 0.5} - 0.5 * n), 0.5);
  EXPECT_LE(r.error, 1e-13);
  CellField<Real> alpha(mesh);
  EXPECT_NEAR(fill(alpha, mesh, box({4, 4, 4})).volume, 1, 1e-14);
  EXPECT_EQ(fill(alpha, mesh, translate(sphere(1), {5, 0, 0})).volume, 0);
}

TEST(Fill, CrossesPeriodicSeams) {
  const Mesh mesh =
      test::read_box({{16, 16, 0}, {1, 1, 1}, false, {"left", "right", "bottom", "top"}});
  for (const Vec3& x : {Vec3{0.95, 0.5, 0}, {0.02, 0.97, 0}, {1, 1, 0}, {0, 1, 0}}) {
    const Result r = filled(mesh, translate(sphere(0.2), x), disc_area(0.2));
    EXPECT_LE(r.error, 1e-6);
    EXPECT_EQ(r.clearance, infinity);  // there is no boundary
  }
  // A whole number of cells along the mesh moves the fractions with it.
  CellField<Real> inside(mesh), across(mesh);
  fill(inside, mesh, translate(sphere(0.2), {0.503, 0.501, 0}));
  fill(across, mesh, translate(sphere(0.2), {1.003, 1.001, 0}));
  Sum difference;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Vec3 x = mesh.C[c];
    difference.add((inside[c] * std::cos(2 * pi * x.x) + across[c] * std::cos(2 * pi * x.x)) *
                   mesh.V[c]);
  }
  EXPECT_NEAR(difference.total(), 0, 1e-9);
}

TEST(Fill, TellsHowFarTheBoundaryIs) {
  const Mesh mesh = test::read_box({{16, 16, 0}});
  EXPECT_NEAR(filled(mesh, translate(sphere(0.2), {0.3, 0.5, 0}), disc_area(0.2)).clearance, 0.1,
              1e-14);
  const Result out = filled(mesh, translate(sphere(0.2), {0.1, 0.5, 0}), disc_area(0.2));
  EXPECT_NEAR(out.clearance, -0.1, 1e-14);
  EXPECT_GT(out.error, 0.1);
}

TEST(Fill, SetsTheHalo) {
  const Mesh mesh = test::read_box({{12, 12, 0}, {1, 1, 1}, true});
  CellField<Real> alpha(mesh, -1), again(mesh);
  fill(alpha, mesh, translate(sphere(0.3), centre_2d));
  again.assign(alpha);
  mesh.halo.update(again);
  for (Index c = 0; c < mesh.n_cells; ++c) EXPECT_EQ(alpha[c], again[c]);
}

}  // namespace
}  // namespace fsi::vof
