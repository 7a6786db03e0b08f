#include "libfsi/vof/bend.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/vof/face_fraction.hpp"
#include "libfsi/vof/fill.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::vof {
namespace {

constexpr Real ball_radius = 0.3;
const Vec3 ball_centre{0.51, 0.49, 0.5};

/// The part of a face inside the sphere.
Real part_inside(const Mesh& mesh, Index f, Index c) {
  const auto points = mesh.face_points[f];
  constexpr int n = 40;
  int inside = 0, all = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n - i; ++j) {
      const Real a = (i + 1.0 / 3) / n, b = (j + 1.0 / 3) / n;
      const Vec3 x = mesh.corner(f, 0, c) + a * (mesh.corner(f, 1, c) - mesh.corner(f, 0, c)) +
                     b * (mesh.corner(f, 2, c) - mesh.corner(f, 0, c));
      inside += norm(x - ball_centre) < ball_radius ? 1 : 0, ++all;
    }
  EXPECT_EQ(points.size(), 3U);
  return static_cast<Real>(inside) / all;
}

struct SphereOnTets {
  Mesh mesh = test::read_box({.n = {12, 12, 12}, .simplex = true});
  CellField<Real> alpha{mesh};
  Interface interface { mesh };
  CellField<Bend> bend{mesh};

  SphereOnTets() {
    fill(alpha, mesh, shapes::translate(shapes::sphere(ball_radius), ball_centre), {},
         {1e-4, 0, 4});
    ReconstructScratch scratch(mesh);
    reconstruct(interface, alpha, mesh, scratch);
    geometry::Polytope cell(3);
    set_bend(bend, interface, mesh, {}, cell);
  }
};

// K of a sphere is (1 - n n) / r.
TEST(Bend, OfASphere) {
  const SphereOnTets sphere;
  Sum trace_K, off, count;
  for (const Index c : sphere.interface.cells) {
    const Vec3& n = sphere.interface.piece[c].n_hat;
    EXPECT_NEAR(norm(dot(sphere.bend[c].K, n)), 0, 1e-12);
    trace_K.add(trace(sphere.bend[c].K)), count.add(1);
    off.add(sphere.bend[c].mean);
  }
  const Real mean = trace_K.total() / count.total();
  if (rank() == 0) std::printf("mean trace of K times r: %.3f\n", mean * ball_radius);
  EXPECT_NEAR(mean * ball_radius, 2, 0.2);
  EXPECT_GT(off.total(), 0);
}

// Planes stick out at the rim of a cell, so that too much of its faces lies behind them.
TEST(Bend, PartsOfFacesAreThoseOfTheSphere) {
  const SphereOnTets sphere;
  std::array<Sum, 5> sums;  // excess and error of planes, of paraboloids; area
  for (const Index c : sphere.interface.cells) {
    const Piece& p = sphere.interface.piece[c];
    for (const Index f : sphere.mesh.cell_faces[c]) {
      const Real A = norm(sphere.mesh.Sf[f]), exact = part_inside(sphere.mesh, f, c);
      const Real plane = swept_part(sphere.mesh, f, c, p, 0, 0) - exact;
      const Real bent = swept_part(sphere.mesh, f, c, p, sphere.bend[c], {}, 0, 0) - exact;
      sums[0].add(A * plane), sums[1].add(A * std::abs(plane));
      sums[2].add(A * bent), sums[3].add(A * std::abs(bent));
      sums[4].add(A);
    }
  }
  std::array<Real, 5> t{};
  Sum::totals(t, sums);
  if (rank() == 0)
    std::printf("mean excess and error of planes %.2e, %.2e, with a bend %.2e, %.2e\n", t[0] / t[4],
                t[1] / t[4], t[2] / t[4], t[3] / t[4]);
  EXPECT_GT(t[0] / t[4], 4e-3);
  EXPECT_LE(std::abs(t[2]), t[0] / 3);
  EXPECT_LE(t[3], 0.75 * t[1]);
}

// A cell without a bend has the parts of its plane to the last digit.
TEST(Bend, NoneIsThePlane) {
  const SphereOnTets sphere;
  for (const Index c : sphere.interface.cells)
    for (const Index f : sphere.mesh.cell_faces[c]) {
      const Piece& p = sphere.interface.piece[c];
      EXPECT_EQ(swept_part(sphere.mesh, f, c, p, Bend{}, {0.1, 0.2, 0.3}, 0, 0.01),
                swept_part(sphere.mesh, f, c, p, 0, 0.01));
    }
}

// Only tetrahedra bend.
TEST(Bend, HexesAndTrianglesHaveNone) {
  EXPECT_FALSE(any_cell_bends(test::read_box({.n = {3, 3, 3}})));
  EXPECT_FALSE(any_cell_bends(test::read_box({.n = {3, 3, 0}, .simplex = true})));
  EXPECT_TRUE(any_cell_bends(test::read_box({.n = {3, 3, 3}, .simplex = true})));
}

}  // namespace
}  // namespace fsi::vof
