// What a kink at the surface adds to the mean of a cut cell.

#include "libfsi/vof/reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::vof {
namespace {

/// The mean of max(0, q) over a triangle or tetrahedron, q linear with distinct values q_i at its
/// n corners: sum_i max(0, q_i)^n / (n prod_j (q_i - q_j)), a divided difference
/// (Hermite-Genocchi).
Real mean_of_positive(const std::vector<Real>& q) {
  const auto n = static_cast<Real>(q.size());
  Real sum = 0;
  for (const Real a : q) {
    Real term = std::pow(std::max(Real{0}, a), n) / n;
    for (const Real b : q)
      if (a != b) term /= a - b;
    sum += term;
  }
  return sum;
}

// A plane through a box of triangles or tetrahedra; cells without a plane have none.
TEST(Reach, IsTheMeanDistanceOnEitherSide) {
  for (const Index depth : {0, 3}) {
    const Mesh mesh = test::read_box({.n = {4, 3, depth}, .simplex = true});
    const Vec3 normal = depth == 0 ? Vec3{3, 1.3, 0} : Vec3{3, 1.3, 2.2}, n = normal / norm(normal);
    const Vec3 at{0.4, 0.5, depth == 0 ? 0 : 0.5};
    Interface interface(mesh);
    geometry::Polytope cell(mesh.dim);
    for (Index c = 0; c < mesh.n_owned; ++c) {
      gather(cell, mesh, c);
      const geometry::Cut cut = geometry::cut(cell, {n, dot(n, at - mesh.C[c])});
      if (!(cut.area > 0)) continue;
      interface.piece[c] = {n, mesh.C[c] + cut.centre, cut.area};
      interface.cells.push_back(c);
    }
    Reach reach(mesh);
    reach.set(interface);
    EXPECT_GT(global_max(static_cast<Real>(interface.cells.size())), 4);
    for (const Index c : interface.cells) {
      gather(cell, mesh, c);
      std::vector<Vec3> corners;
      for (const Vec3& x : cell.points()) {
        const auto same = [&](const Vec3& y) { return norm(x - y) < 1e-12; };
        if (std::ranges::none_of(corners, same)) corners.push_back(x);
      }
      std::vector<Real> q;
      for (const Vec3& x : corners) q.push_back(dot(n, x + mesh.C[c] - at));
      EXPECT_NEAR(dot(n, reach.beyond[c]), mean_of_positive(q), 1e-12);
      for (Real& value : q) value = -value;
      EXPECT_NEAR(dot(n, reach.behind[c]), mean_of_positive(q), 1e-12);
      EXPECT_NEAR(dot(n, reach.beyond[c] - reach.behind[c]), dot(n, mesh.C[c] - at), 1e-14);
    }
    interface.cells.clear();
    reach.set(interface);
    for (Index c = 0; c < mesh.n_cells; ++c)
      EXPECT_EQ(norm2(reach.beyond[c]) + norm2(reach.behind[c]), 0);
  }
}

}  // namespace
}  // namespace fsi::vof
