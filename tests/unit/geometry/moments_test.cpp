#include "libfsi/geometry/moments.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace fsi::geometry {
namespace {

Polytope unit_square() {
  Polytope cell(2);
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::array<Vec3, 2> edge{x[i], x[(i + 1) % 4]};
    cell.add_face(edge, false);
  }
  return cell;
}

Polytope unit_cube() {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  Polytope cell;
  for (const auto& face : std::vector<std::array<std::size_t, 4>>{
           {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
    const std::array<Vec3, 4> corners{x[face[0]], x[face[1]], x[face[2]], x[face[3]]};
    cell.add_face(corners, false);
  }
  return cell;
}

void expect_near(const Moments& a, const Moments& b) {
  constexpr Real round_off = 1e-14;
  EXPECT_NEAR(a.volume, b.volume, round_off);
  EXPECT_LE(norm(a.first - b.first), round_off);
  const SymTensor d = a.second - b.second;
  for (const Real item : {d.xx, d.xy, d.xz, d.yy, d.yz, d.zz}) EXPECT_NEAR(item, 0, round_off);
}

/// 0 < x < l, the other coordinates in the unit square: integrals of 1, x, x x.
Moments slab(Real l, int dim) {
  const Real z = dim == 3 ? 1 : 0;
  return {l,
          {l * l / 2, l / 2, z * l / 2},
          {l * l * l / 3, l * l / 4, z * l * l / 4, l / 3, z * l / 4, z * l / 3}};
}

TEST(Moments, Slabs) {
  for (const Polytope& cell : {unit_square(), unit_cube()}) {
    expect_near(moments(cell), slab(1, cell.dim()));
    for (const Real l : {0.1, 0.5, 0.93})
      expect_near(moments_below(cell, {{1, 0, 0}, l}), slab(l, cell.dim()));
  }
}

TEST(Moments, BothSidesOfAnyPlaneMakeTheWhole) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> any(-1, 1);
  for (const Polytope& cell : {unit_square(), unit_cube()}) {
    for (int i = 0; i < 200; ++i) {
      Vec3 n{any(random), any(random), cell.dim() == 3 ? any(random) : 0};
      n = n / norm(n);
      const Real s = dot(n, Vec3{0.5, 0.5, 0.5}) + 0.6 * any(random);
      const Moments below = moments_below(cell, {n, s}), above = moments_below(cell, {-n, -s});
      EXPECT_NEAR(below.volume, measure_below(cell, {n, s}), 1e-14);
      expect_near(
          {below.volume + above.volume, below.first + above.first, below.second + above.second},
          moments(cell));
    }
  }
}

}  // namespace
}  // namespace fsi::geometry
