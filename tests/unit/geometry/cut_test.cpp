#include "libfsi/geometry/cut.hpp"

#include <gtest/gtest.h>

#include <random>

namespace fsi::geometry {
namespace {

/// The unit cube about the origin, sheared by a linear map so that nothing is special.
Cell parallelepiped(const Tensor& map) {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis)
    for (const Real side : {-0.5, 0.5}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      Polygon face;
      face.n = 4;
      const Real turn[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
      for (int i = 0; i < 4; ++i) {
        Vec3 x;
        x[axis] = side, x[a] = turn[side > 0 ? i : 3 - i][0], x[b] = turn[side > 0 ? i : 3 - i][1];
        face.x[static_cast<std::size_t>(i)] = dot(map, x);
      }
      const Vec3 area = cross(face.x[2] - face.x[0], face.x[3] - face.x[1]) * 0.5;
      add_face(cell, face, area);
    }
  return cell;
}

Cell square() {
  Cell cell;
  cell.dim = 2;
  const Vec3 corner[4] = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  const Vec3 outward[4] = {{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  for (int i = 0; i < 4; ++i) {
    Polygon edge;
    edge.n = 2;
    edge.x[0] = corner[i], edge.x[1] = corner[(i + 1) % 4];
    add_face(cell, edge, outward[i]);
  }
  return cell;
}

Vec3 random_unit(std::mt19937& generator, int dim) {
  std::normal_distribution<Real> normal;
  Vec3 n{normal(generator), normal(generator), dim == 3 ? normal(generator) : 0};
  return n / norm(n);
}

TEST(Cut, KnownVolumes) {
  const Cell cube = parallelepiped({1, 0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_NEAR(volume_below(cube, {1, 0, 0}, 0.25), 0.75, 1e-15);
  // The corner tetrahedron of legs 1/2: volume 1/48.
  const Real r = 1 / std::sqrt(3.0);
  EXPECT_NEAR(volume_below(cube, {r, r, r}, (-1.5 + 0.5) * r), 1.0 / 48, 1e-15);
  EXPECT_NEAR(volume_below(square(), {std::sqrt(0.5), std::sqrt(0.5), 0}, 0), 0.5, 1e-15);
}

TEST(Cut, BelowAndAboveMakeTheWhole) {
  std::mt19937 generator(1);
  const Cell cell = parallelepiped({1, 0.3, -0.2, 0.1, 0.8, 0.4, 0, 0.2, 1.5});
  const Real V = volume_below(cell, {1, 0, 0}, 100);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 n = random_unit(generator, 3);
    const Real s = std::uniform_real_distribution<Real>(-1, 1)(generator);
    ASSERT_NEAR(volume_below(cell, n, s) + volume_below(cell, -n, -s), V, 1e-14);
  }
}

TEST(Cut, ThePlaneOfAFractionLeavesThatFraction) {
  std::mt19937 generator(2);
  const Cell cells[] = {parallelepiped({1, 0.3, -0.2, 0.1, 0.8, 0.4, 0, 0.2, 1.5}), square()};
  for (const Cell& cell : cells)
    for (int i = 0; i < 2000; ++i) {
      Vec3 n = random_unit(generator, cell.dim);
      if (i % 10 == 0) n = {1, 0, 0};
      const Real V = volume_below(cell, n, 100);
      const Real alpha = i % 3 == 0 ? 1e-8 : std::uniform_real_distribution<Real>(0, 1)(generator);
      const Cut cut = cut_at_fraction(cell, n, alpha);
      ASSERT_NEAR(volume_below(cell, n, cut.s), alpha * V, 1e-13 * V);
      ASSERT_NEAR(dot(n, cut.centre), cut.s, 1e-12);
    }
}

TEST(Cut, ASweptFaceIntegratesThePassage) {
  Polygon face;
  face.n = 4;
  face.x = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
  // A plane sweeping along x from -1 to 2 in three time units: covered x of [0, 1], mean 1/2 of one
  // unit and all of another.
  EXPECT_NEAR(mean_part_below(face, {1, 0, 0}, -1, 1, 3), 0.5, 1e-15);
  EXPECT_NEAR(mean_part_below(face, {1, 0, 0}, 2, -1, 3), 0.5, 1e-15);
  // Along the diagonal from corner to centre: part = 2 t^2 / 2 of the square, mean of t^2 over
  // sigma in [0, 1] with the part sigma^2 / 2: 1/6.
  const Real r = std::sqrt(0.5);
  EXPECT_NEAR(mean_part_below(face, {r, r, 0}, 0, r, 1), 1.0 / 6, 1e-15);
  EXPECT_NEAR(mean_part_below(face, {r, r, 0}, r / 2, 0, 1), 0.125, 1e-15);
}

}  // namespace
}  // namespace fsi::geometry
