#include "libfsi/analysis/ring.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "libfsi/analysis/orientation.hpp"
#include "libfsi/analysis/surface.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/vof/fill.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::analysis {
namespace {

using shapes::pi;

/// The image of a torus (angle about the axis, angle about the tube) as triangles, dealt out to
/// ranks.
Surface mapped(const std::function<Vec3(Real, Real)>& x) {
  constexpr int n = 128, m = 64;
  Surface s{3, {}};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      if ((i * m + j) % ranks() != rank()) continue;
      const auto at = [&](int k, int l) { return x(2 * pi * (i + k) / n, 2 * pi * (j + l) / m); };
      s.points.insert(s.points.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return s;
}

TEST(Ring, FrameTurnsWithTheAxis) {
  const Real psi = 0.6;
  const RingFrame f = ring_frame({std::cos(psi), std::sin(psi), 0});
  EXPECT_NEAR(norm(f.zeta - Vec3{0, 0, 1}), 0, 1e-15);
  EXPECT_NEAR(norm(f.eta - Vec3{std::sin(psi), -std::cos(psi), 0}), 0, 1e-15);
  EXPECT_NEAR(norm(ring_frame({0, 0, 1}).zeta - Vec3{0, 1, 0}), 0, 1e-15);
  // PrescribedAdvection along, zeta does not jump where the axis passes z.
  Vec3 zeta{1, 0, 0};
  for (const Real t : {0.0, 0.1, 0.2}) zeta = ring_frame({-std::sin(t), 0, std::cos(t)}, zeta).zeta;
  EXPECT_NEAR(norm(zeta - Vec3{std::cos(0.2), 0, std::sin(0.2)}), 0, 1e-14);
}

// The same surface with each triangle divided in two gives the same sections.
TEST(Ring, DoesNotDependOnHowTheSurfaceIsDivided) {
  const Mesh mesh = test::read_box({.n = {12, 12, 12}});
  CellField<Real> alpha(mesh);
  const Vec3 centre{0.5, 0.55, 0.5}, axis = Vec3{0.3, 1, 0.2} / norm(Vec3{0.3, 1, 0.2});
  vof::fill(alpha, mesh, shapes::translate(shapes::align(shapes::torus(0.26, 0.12), axis), centre));
  const Surface whole = isosurface(alpha, mesh, centre);
  Surface halves{3, {}};
  for (Index k = 0; k < whole.size(); ++k) {
    const Vec3* x = whole.facet(k);
    const Vec3 on_edge = 0.3 * x[0] + 0.7 * x[1];
    halves.points.insert(halves.points.end(), {x[0], on_edge, x[2], on_edge, x[1], x[2]});
  }
  const Ring one = ring(whole, centre, ring_frame(axis)),
             two = ring(halves, centre, ring_frame(axis));
  EXPECT_NEAR(one.bending_meridian, two.bending_meridian, 1e-9);
  EXPECT_NEAR(one.forward.aspect(), two.forward.aspect(), 1e-9);
}

TEST(Ring, UndeformedTorus) {
  const Surface s = mapped([](Real a, Real b) {
    const Real rho = 0.3 + 0.1 * std::cos(b);
    return Vec3{0.1 * std::sin(b), rho * std::cos(a), rho * std::sin(a)};
  });
  const Ring r = ring(s, {}, ring_frame({1, 0, 0}));
  for (const Ellipse* e : {&r.forward, &r.back, &r.right, &r.left}) {
    EXPECT_NEAR(e->aspect(), 1, 1e-3);
    EXPECT_NEAR(e->major, 0.1, 2e-4);
    EXPECT_NEAR(e->x, 0.3, 2e-4);
  }
  EXPECT_NEAR(r.outer.major, 0.4, 1e-3);
  EXPECT_NEAR(r.inner.minor, 0.2, 1e-3);
  EXPECT_NEAR(r.outer.aspect(), 1, 1e-3);
  EXPECT_NEAR(r.bending_meridian, 0, 1e-6);
  EXPECT_NEAR(r.bending_prime, 0, 1e-6);
}

TEST(Ring, BentFlattenedAndElongated) {
  // Axis x; zeta = z, eta = -y. Along eta the ring is drawn out to twice its width and bent toward
  // x, along zeta away from it; the tube is an ellipse of half axes 0.08 (along x) and 0.1.
  const Real up = 0.06, down = 0.04;
  const Surface s = mapped([&](Real a, Real b) {
    const Real rho = 0.3 + 0.1 * std::cos(b), c = std::cos(a), t = std::sin(a);
    return Vec3{0.08 * std::sin(b) + up * c * c - down * t * t, 2 * rho * c, rho * t};
  });
  const Ring r = ring(s, {}, ring_frame({1, 0, 0}));
  EXPECT_NEAR(r.right.aspect(), 0.8, 1e-3);
  EXPECT_NEAR(r.left.aspect(), 0.8, 1e-3);
  EXPECT_NEAR(r.forward.aspect(), 0.4, 1e-3);  // 0.08 to 0.2
  EXPECT_NEAR(r.back.aspect(), 0.4, 1e-3);
  EXPECT_NEAR(r.bending_meridian, 2 * std::atan2(up, 0.6) * 180 / pi, 0.02);
  EXPECT_NEAR(r.bending_prime, -2 * std::atan2(down, 0.3) * 180 / pi, 0.02);
  EXPECT_NEAR(r.outer.aspect(), 0.5, 2e-3);
  EXPECT_NEAR(r.inner.aspect(), 0.5, 2e-3);
}

TEST(Ring, TorusOfVolumeFractions) {
  const Mesh mesh = test::read_box({{32, 32, 32}});
  const Vec3 centre{0.513, 0.497, 0.488};
  CellField<Real> alpha(mesh);
  const Real psi = pi / 4;
  vof::fill(alpha, mesh,
            shapes::translate(shapes::rotate(shapes::torus(0.3, 0.1), {0, 0, 1}, psi), centre), {},
            {1e-4, 0, 4});
  const Surface s = isosurface(alpha, mesh, centre);
  const Ring r = ring(s, centre, ring_frame({std::cos(psi), std::sin(psi), 0}));
  for (const Ellipse* e : {&r.forward, &r.back, &r.right, &r.left}) {
    EXPECT_NEAR(e->aspect(), 1, 0.01);
    EXPECT_NEAR(e->x, 0.3, 2e-3);
    EXPECT_NEAR(e->y, 0, 2e-3);
  }
  EXPECT_NEAR(r.outer.aspect(), 1, 1e-3);
  EXPECT_NEAR(r.inner.aspect(), 1, 1e-3);
  EXPECT_NEAR(r.bending_meridian, 0, 0.05);
  EXPECT_NEAR(r.bending_prime, 0, 0.05);
}

// Half a ring on a plane of symmetry is measured as the whole one.
TEST(Ring, OnAPlaneOfSymmetry) {
  const Mesh mesh = test::read_box({{32, 32, 16}, {1, 1, 0.5}});
  CellField<Real> alpha(mesh);
  const Real psi = pi / 4;
  const vof::Filled filled = vof::fill(
      alpha, mesh,
      shapes::translate(shapes::rotate(shapes::torus(0.3, 0.1), {0, 0, 1}, psi), {0.5, 0.5, 0}),
      {mesh.patch("back"), mesh.patch("left")}, {1e-4, 0, 4});
  ASSERT_EQ(filled.cut_by.planes.size(), 1U);  // the other plane does not cut it
  EXPECT_NEAR(std::abs(filled.cut_by.planes[0].n.z), 1, 1e-12);
  EXPECT_NEAR(filled.cut_by.planes[0].x.z, 0, 1e-12);
  const Vec3 of_half{0.5, 0.5, 0.2}, centre = filled.cut_by.planes[0].foot(of_half);
  const Surface half = isosurface(alpha, mesh, of_half, filled.cut_by.planes),
                s = with_images(half, filled.cut_by.planes);
  EXPECT_NEAR(area(s), 2 * area(half), 1e-12);
  // the surface lies 0.1 cells inside at a radius of three
  EXPECT_NEAR(area(s), 4 * pi * pi * 0.3 * 0.1, 0.03 * area(s));
  EXPECT_NEAR(enclosed(s), 2 * pi * pi * 0.3 * 0.01, 0.06 * enclosed(s));
  const Orientation o = orientation(s, centre);
  EXPECT_NEAR(angle_to_x(o.n), 45, 0.1);
  const Ring r = ring(s, centre, ring_frame(o.n));
  for (const Ellipse* e : {&r.forward, &r.back, &r.right, &r.left}) {
    EXPECT_NEAR(e->aspect(), 1, 0.015);
    EXPECT_NEAR(e->x, 0.3, 3e-3);
    EXPECT_NEAR(e->y, 0, 2e-3);
  }
  EXPECT_NEAR(r.outer.aspect(), 1, 1e-2);
  EXPECT_NEAR(r.inner.aspect(), 1, 1e-2);
  EXPECT_NEAR(r.bending_prime, 0, 1e-6);
}

// On tetrahedra the centres of the cells at a corner on the plane lie aside of it, too.
TEST(Ring, OfHalfATorusOnTetrahedra) {
  const Mesh mesh = test::read_box({.n = {16, 16, 8}, .length = {1, 1, 0.5}, .simplex = true});
  CellField<Real> alpha(mesh);
  const vof::Filled filled = vof::fill(
      alpha, mesh,
      shapes::translate(shapes::rotate(shapes::torus(0.3, 0.12), {0, 0, 1}, pi / 4), {0.5, 0.5, 0}),
      {mesh.patch("back")}, {1e-4, 0, 4});
  const std::vector<geometry::Mirror>& planes = filled.cut_by.planes;
  const Vec3 of_half{0.5, 0.5, 0.2}, centre = planes[0].foot(of_half);
  const Surface s = with_images(isosurface(alpha, mesh, of_half, planes), planes);
  EXPECT_NEAR(ring(s, centre, ring_frame(orientation(s, centre).n)).bending_meridian, 0, 1);
}

TEST(Ring, NothingWithoutSurface) {
  const Ring r = ring(Surface{3, {}}, {}, ring_frame({1, 0, 0}));
  EXPECT_EQ(r.forward.aspect(), 0);
  EXPECT_EQ(r.outer.aspect(), 0);
  EXPECT_EQ(r.bending_meridian, 0);
}

}  // namespace
}  // namespace fsi::analysis
