#include "libfsi/geometry/cut.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace fsi::geometry {
namespace {

using Random = std::mt19937;

Real any(Random& random, Real a = -1, Real b = 1) {
  return std::uniform_real_distribution<Real>(a, b)(random);
}

Vec3 any_normal(Random& random, int dim) {
  for (;;) {
    const Vec3 n{any(random), any(random), dim == 3 ? any(random) : 0};
    if (const Real size = norm(n); size > 0.1 && size < 1) return n / size;
  }
}

/// Corners as gmsh numbers them, and the faces with outward corners.
struct Shape {
  std::vector<Vec3> x;
  std::vector<std::vector<int>> faces;

  Polytope polytope(int dim = 3) const {
    Polytope cell(dim);
    bool reversed = false;
    for (const auto& face : faces) {
      std::vector<Vec3> corners;
      for (const int i : face) corners.push_back(x[i]);
      if (reversed) corners = {corners.rbegin(), corners.rend()};
      cell.add_face(corners, reversed);
      reversed = !reversed;
    }
    return cell;
  }
};

Shape hex() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
          {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
}
Shape prism() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
          {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
}
Shape tet() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}
Shape quad() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
}
Shape triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1}, {1, 2}, {2, 0}}}; }
/// Faces with five corners.
Shape pentagonal_prism() {
  Shape shape;
  for (const Real z : {0.0, 1.0})
    for (int i = 0; i < 5; ++i)
      shape.x.push_back({std::cos(0.4 * i * 3.14159265), std::sin(0.4 * i * 3.14159265), z});
  shape.faces = {{4, 3, 2, 1, 0}, {5, 6, 7, 8, 9}};
  for (int i = 0; i < 5; ++i) shape.faces.push_back({i, (i + 1) % 5, (i + 1) % 5 + 5, i + 5});
  return shape;
}

struct Sample {
  Polytope cell;
  Real V;
};

/// Cells of every kind, moved at random, some thin, hexes warped.
Sample sample(int kind, Random& random) {
  Shape shape = std::vector{hex, prism, tet, pentagonal_prism, quad, triangle}[kind]();
  const int dim = kind < 4 ? 3 : 2;
  const Real thin = kind % 2 == 0 ? 1 : std::pow(10, any(random, -2, 0));
  for (Vec3& x : shape.x) {
    x = {x.x + 0.1 * any(random), thin * (x.y + 0.1 * any(random)),
         dim == 3 ? x.z + 0.1 * any(random) : 0};
  }
  const Polytope cell = shape.polytope(dim);
  return {cell, measure(cell)};
}

TEST(Cut, MeasuresOfKnownCells) {
  EXPECT_DOUBLE_EQ(measure(hex().polytope()), 1);
  EXPECT_DOUBLE_EQ(measure(prism().polytope()), 0.5);
  EXPECT_DOUBLE_EQ(measure(tet().polytope()), 1.0 / 6);
  EXPECT_DOUBLE_EQ(measure(quad().polytope(2)), 1);
  EXPECT_DOUBLE_EQ(measure(triangle().polytope(2)), 0.5);
}

TEST(Cut, KnownPartsOfTheCube) {
  const Polytope cube = hex().polytope();
  const Vec3 n = Vec3{1, 1, 1} / std::sqrt(3.0);
  for (const Real s : {0.1, 0.5, 0.9, 1.0}) {  // a corner tetrahedron of edge s
    EXPECT_NEAR(measure_below(cube, {n, s / std::sqrt(3.0)}), s * s * s / 6, 1e-16);
  }
  const Cut middle = cut(cube, {n, 1.5 / std::sqrt(3.0)});  // the regular hexagon of edge 1/sqrt 2
  EXPECT_NEAR(middle.area, 0.75 * std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(norm(middle.centre - Vec3{0.5, 0.5, 0.5}), 0, 1e-15);
  for (const Real s : {0.0, 0.25, 1.0}) EXPECT_EQ(measure_below(cube, {{0, 0, 1}, s}), s);
  EXPECT_EQ(measure_below(cube, {n, -0.1}), 0);
  EXPECT_DOUBLE_EQ(measure_below(cube, {n, 2}), 1);
  const Cut corner = cut(tet().polytope(), {{0, 0, 1}, 0.5});
  EXPECT_DOUBLE_EQ(corner.area, 0.125);
  EXPECT_NEAR(norm(corner.centre - Vec3{0.5 / 3, 0.5 / 3, 0.5}), 0, 1e-16);
  const Cut edge = cut(quad().polytope(2), {Vec3{1, 1, 0} / std::sqrt(2.0), 0.5 / std::sqrt(2.0)});
  EXPECT_DOUBLE_EQ(edge.area, std::sqrt(0.5));
  EXPECT_NEAR(norm(edge.centre - Vec3{0.25, 0.25, 0}), 0, 1e-16);
  EXPECT_EQ(cut(cube, {n, -0.1}).area, 0);
}

TEST(Cut, SpreadOfKnownCuts) {
  const Cut square = cut(hex().polytope(), {{0, 0, 1}, 0.3});
  EXPECT_NEAR(square.spread.xx, 1.0 / 12, 1e-15);
  EXPECT_NEAR(square.spread.yy, 1.0 / 12, 1e-15);
  EXPECT_NEAR(square.spread.xy, 0, 1e-15);
  EXPECT_NEAR(square.spread.zz, 0, 1e-15);
  const Cut corner = cut(tet().polytope(), {{0, 0, 1}, 0.5});  // legs of 1/2
  EXPECT_NEAR(corner.spread.xx, 0.25 / 18, 1e-16);
  EXPECT_NEAR(corner.spread.xy, -0.25 / 36, 1e-16);
  const Cut edge = cut(quad().polytope(2), {Vec3{1, 0, 0}, 0.4});
  EXPECT_NEAR(edge.spread.yy, 1.0 / 12, 1e-15);
  EXPECT_NEAR(edge.spread.xx, 0, 1e-15);
}

TEST(Cut, BothSidesFillTheCell) {
  Random random(1);
  for (int i = 0; i < 6000; ++i) {
    const auto [cell, V] = sample(i % 6, random);
    const Vec3 n = any_normal(random, cell.dim());
    const Real s = any(random, -0.5, 1.5);
    const Real below = measure_below(cell, {n, s}), above = measure_below(cell, {-n, -s});
    ASSERT_NEAR(below + above, V, 2e-15);
    ASSERT_GE(below, -1e-15);
    ASSERT_GE(above, -1e-15);
  }
}

TEST(Cut, PlaneAtTheFraction) {
  Random random(2);
  for (int i = 0; i < 12000; ++i) {
    const auto [cell, V] = sample(i % 6, random);
    Vec3 n = any_normal(random, cell.dim());
    if (i % 7 == 0) n = {0, 1, 0};
    Real fraction = any(random, 0, 1);
    if (i % 3 == 0) fraction = std::pow(10, any(random, -8, -1));
    if (i % 3 == 1) fraction = 1 - std::pow(10, any(random, -8, -1));
    const Plane plane = plane_at(cell, n, fraction);
    ASSERT_NEAR(measure_below(cell, plane), fraction * V, 2e-15) << i;  // corners of order 1
    ASSERT_EQ(plane_at(cell, -n, 1 - fraction).s, -plane_at(cell, n, 1 - (1 - fraction)).s) << i;
    const Cut part = cut(cell, plane);
    ASSERT_GT(part.area, 0);
    ASSERT_NEAR(dot(n, part.centre), plane.s, 1e-14);
  }
}

TEST(Cut, AreaIsTheDerivativeAndTheCentreTheTurningPoint) {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const auto [cell, V] = sample(i % 6, random);
    const Vec3 n = any_normal(random, cell.dim());
    const Plane plane = plane_at(cell, n, any(random, 0.05, 0.95));
    const Cut part = cut(cell, plane);
    const Real e = 1e-5, size = std::pow(V, 1.0 / cell.dim());
    const Real slope =
        (measure_below(cell, {n, plane.s + e}) - measure_below(cell, {n, plane.s - e})) / (2 * e);
    ASSERT_NEAR(part.area, slope, 1e-3 * V / size);
    ASSERT_NEAR(below(cell, plane).area, part.area, 1e-13);
    // Turned about its centroid the plane keeps the volume below it to first order.
    Vec3 t = cell.dim() == 3 ? cross(n, any_normal(random, 3)) : Vec3{-n.y, n.x, 0};
    const Real angle = 1e-5;
    const auto turned = [&](Real a) {
      const Vec3 m = (n + a * t) / norm(n + a * t);
      return measure_below(cell, {m, dot(m, part.centre)});
    };
    ASSERT_NEAR((turned(angle) - turned(-angle)) / (2 * angle), 0, 2e-3 * part.area);
  }
}

/// Composite Gauss rule of 3 points, exact on each piece between breaks for degree 5.
template <std::size_t n>
Real quadrature(const Levels<n>& q, Real s0, Real s1) {
  std::vector<Real> breaks{std::min(s0, s1), std::max(s0, s1)};
  for (const Real level : q)
    if (level > breaks[0] && level < std::max(s0, s1)) breaks.push_back(level);
  std::sort(breaks.begin(), breaks.end());
  Real sum = 0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const Real h = (breaks[i + 1] - breaks[i]) / 2, m = (breaks[i + 1] + breaks[i]) / 2;
    for (const auto& [t, w] :
         {std::pair{0.0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}, {-std::sqrt(0.6), 5.0 / 9}})
      sum += h * w * part_below(q, m + h * t);
  }
  return sum / std::abs(s1 - s0);
}

TEST(Sweep, MeanPartIsExact) {
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    Levels<3> q{any(random), any(random), any(random)};
    if (i % 5 == 0) q[1] = q[0];
    if (i % 7 == 0) q[2] = q[1];
    std::sort(q.begin(), q.end());
    Levels<2> e{q[0], q[2]};
    const Real s0 = any(random), s1 = i % 3 == 0 ? s0 + 1e-6 * any(random) : any(random);
    ASSERT_NEAR(mean_part_below(q, s0, s1), quadrature(q, s0, s1), 1e-13);
    ASSERT_NEAR(mean_part_below(e, s0, s1), quadrature(e, s0, s1), 1e-13);
    ASSERT_EQ(mean_part_below(q, s0, s0), part_below(q, s0));
    ASSERT_EQ(mean_part_below(q, -3, -2), 0);
    ASSERT_EQ(mean_part_below(q, 2, 3), 1);
  }
}

}  // namespace
}  // namespace fsi::geometry
