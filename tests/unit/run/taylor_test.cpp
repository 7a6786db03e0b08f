// The measured deformation of ellipses and ellipsoids whose own is known.

#include "libfsi/run/taylor.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/box_mesh.hpp"

namespace fsi {
namespace {

struct TaylorError {
  Real deformation, angle;
};

/// Half-axes 0.27 and 0.18 (0.2 along z) at 35 degrees, cells of size 1 / n.
TaylorError measured(const Mesh& mesh, Real z) {
  constexpr Real angle = 35;
  const shapes::Shape shape = shapes::translate(
      shapes::rotate(shapes::ellipsoid({0.27, 0.18, 0.2}), {0, 0, 1}, angle * shapes::pi / 180),
      {0.513, 0.497, z});
  const FaceWeights weights(mesh);
  const Body body(mesh, weights, {.shape = shape, .G = 1}, {});
  const CellField<Vec3> u(mesh);
  const Taylor t = taylor(body, u, {0.5, 0.5, z}, 0);
  return {std::abs(t.deformation / 0.2 - 1), std::abs(t.angle - angle)};
}

TEST(Taylor, EllipseToSecondOrder) {
  const TaylorError coarse = measured(test::box_mesh({.n = {24, 24, 0}}), 0);
  const TaylorError fine = measured(test::box_mesh({.n = {96, 96, 0}}), 0);
  EXPECT_LE(coarse.deformation, 1e-2);
  EXPECT_LE(coarse.angle, 0.1);
  EXPECT_LE(fine.deformation, coarse.deformation / 9);
}

TEST(Taylor, Ellipsoid) {
  const TaylorError e = measured(test::box_mesh({.n = {32, 32, 32}}), 0.488);
  EXPECT_LE(e.deformation, 5e-3);
  EXPECT_LE(e.angle, 0.1);
}

// Half an ellipse, and a quarter, on planes of symmetry: that of the whole one.
TEST(Taylor, OnPlanesOfSymmetry) {
  const Mesh mesh = test::box_mesh({.n = {48, 48, 0}});
  const FaceWeights weights(mesh);
  for (const Real x : {0.5, 0.0}) {
    const shapes::Shape shape =
        shapes::translate(shapes::ellipsoid({0.36, 0.24, shapes::infinity}), {x, 0, 0});
    std::vector<Patch> mirrors{mesh.patch("bottom")};
    if (x == 0) mirrors.push_back(mesh.patch("left"));
    const Body body(mesh, weights, {.shape = shape, .G = 1}, {}, {.mirrors = mirrors});
    EXPECT_EQ(body.filled.cut_by.planes.size(), mirrors.size());
    const Taylor t = taylor(body, CellField<Vec3>(mesh), {x, 0.1, 0}, 0);
    EXPECT_NEAR(t.deformation, 0.2, 1e-3);
    EXPECT_NEAR(t.angle, 0, 0.1);
  }
}

// In the flow u = (y, 0) the moments change as those of x + t y do.
TEST(Taylor, MovedOnWithTheFlow) {
  const Mesh mesh = test::box_mesh({.n = {64, 64, 0}});
  const FaceWeights weights(mesh);
  const Body body(mesh, weights,
                  {.shape = shapes::translate(shapes::sphere(0.3), {0.5, 0.5, 0}), .G = 1}, {});
  CellField<Vec3> u(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) u[c] = {mesh.C[c].y, 0, 0};
  // a circle sheared by g: D = g / 2 + O(g^3), at 45 degrees - g / 4
  const Taylor t = taylor(body, u, {0.5, 0.5, 0}, 1e-3);
  EXPECT_NEAR(t.deformation, 5e-4, 5e-6);
  EXPECT_NEAR(t.angle, 45, 0.1);
}

}  // namespace
}  // namespace fsi
