// Slopes and quadratics by least squares: exact for what they fit, and what they do without enough.

#include "libfsi/operators/least_squares.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

const Tensor L{1, 2, -1, 0.5, -3, 4, 2, 1, 2};
const std::array<Vec3, 4> places{{{1, 0.2, 0.1}, {-0.3, 0.8, 0.2}, {0.1, -0.4, 0.9}, {1, 1, -1}}};

Real difference(const Tensor& a, const Tensor& b) {
  const Tensor d = a + -1.0 * b;
  return norm({norm({d.xx, d.xy, d.xz}), norm({d.yx, d.yy, d.yz}), norm({d.zx, d.zy, d.zz})});
}

TEST(SlopeFit, IsExactForALinearVelocity) {
  for (const Tensor& guess : {Tensor{}, Tensor{9, 8, 7, 6, 5, 4, 3, 2, 1}}) {
    SlopeFit fit(guess);
    for (const Vec3& r : places) EXPECT_EQ(fit.add(r, dot(L, r)), 1 / norm2(r));
    EXPECT_TRUE(tells(fit.M, 3, 1e-3));
    EXPECT_LE(difference(fit.slope(1e-3), L), 1e-13);
    EXPECT_LE(difference(guess + dot(fit.R, inverse(fit.M)), L), 1e-13);
    EXPECT_LE(difference(guess + dot(fit.R, raised_inverse(fit.M, 3)), L), 1e-13);
    EXPECT_LE(difference(guess + dot(fit.R, pseudo_inverse(fit.M, 1e-3)), L), 1e-13);
  }
}

// u = L . r + (r . r) a has the slope L + 2 a r at r.
TEST(SlopeFit, PairsAreExactForAQuadraticVelocity) {
  const Vec3 a{1, -2, 3};
  SlopeFit pairs, values;
  for (const Vec3& r : places) {
    const Vec3 du = dot(L, r) + norm2(r) * a;
    pairs.add_pair(r, du, L + 2 * outer(a, r));
    values.add(r, du);
  }
  EXPECT_LE(difference(pairs.slope(1e-3), L), 1e-13);
  EXPECT_GE(difference(values.slope(1e-3), L), 0.1);
}

// Along a direction without places: the guess, zero, or next to zero.
TEST(SlopeFit, LeavesOutWhatTheDirectionsDoNotTell) {
  const Vec3 e = Vec3{1, 2, 2} / 3;
  const Tensor guess{9, 8, 7, 6, 5, 4, 3, 2, 1};
  SlopeFit fit(guess);
  for (const Vec3& r : {Vec3{2, -1, 0}, Vec3{0, 1, -1}, Vec3{2, 0, -1}}) {
    ASSERT_NEAR(dot(r, e), 0, 1e-15);
    fit.add(r, dot(L, r));
  }
  EXPECT_FALSE(tells(fit.M, 3, 1e-3));
  EXPECT_LE(norm(dot(fit.slope(0.05), e) - dot(guess, e)), 1e-12);
  EXPECT_LE(norm(dot(fit.slope(0.05), Vec3{2, -1, 0}) - dot(L, Vec3{2, -1, 0})), 1e-12);
  EXPECT_LE(norm(dot(pseudo_inverse(fit.M, 0.05), e)), 1e-12);
  EXPECT_LE(norm(dot(dot(fit.R, raised_inverse(fit.M, 3)), e)), 1e-12);
}

TEST(SlopeFit, InTheOnePlaneOfTwoDimensions) {
  SlopeFit fit;
  for (const Vec3& r : {Vec3{1, 0.5, 0}, Vec3{-0.2, 1, 0}, Vec3{0.3, -1, 0}}) fit.add(r, dot(L, r));
  EXPECT_TRUE(tells(fit.M, 2, 1e-3));
  EXPECT_FALSE(tells(fit.M, 3, 1e-3));
  const Tensor g = dot(fit.R, raised_inverse(fit.M, 2));
  EXPECT_LE(norm(dot(g, Vec3{1, 1, 0}) - dot(L, Vec3{1, 1, 0})), 1e-13);
  EXPECT_EQ(norm(dot(g, Vec3{0, 0, 1})), 0);
}

TEST(InverseMoments, SlopesAreExactForLinearFields) {
  for (const Index depth : {0, 5})
    for (const bool simplex : {false, true}) {
      const Mesh mesh = test::read_box({.n = {7, 6, depth}, .simplex = simplex});
      const Vec3 slope{1, -2, mesh.dim == 3 ? 3.0 : 0.0};
      CellField<Real> q(mesh);
      CellField<Vec3> u(mesh);
      for (Index c = 0; c < mesh.n_cells; ++c)
        q[c] = dot(slope, mesh.C[c]), u[c] = dot(L, mesh.C[c]);
      const Vec3 x{1, 2, mesh.dim == 3 ? -1.0 : 0.0};
      Real worst = 0;
      for (Index c = 0; c < mesh.n_owned; ++c) {
        const SymTensor inverse = inverse_moments(mesh, c);
        worst = std::max(worst, norm(slope_at(q, inverse, mesh, c) - slope));
        worst = std::max(worst, norm(dot(slope_at(u, inverse, mesh, c), x) - dot(L, x)));
      }
      EXPECT_LE(global_max(worst), 1e-11) << mesh.dim << " " << simplex;
    }
}

// A layer one cell thick tells nothing of what changes across it: that part of the slope is zero.
TEST(InverseMoments, NothingAcrossAThinLayer) {
  const Mesh mesh = test::read_box({.n = {6, 1, 5}});
  CellField<Real> q(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) q[c] = dot(Vec3{1, -2, 3}, mesh.C[c]);
  for (Index c = 0; c < mesh.n_owned; ++c)
    EXPECT_LE(norm(slope_at(q, inverse_moments(mesh, c), mesh, c) - Vec3{1, 0, 3}), 1e-11);
}

TEST(QuadraticFit, IsExactForAQuadraticVelocity) {
  for (const int dim : {2, 3}) {
    const Vec3 a{1, -2, 3}, b{0.5, 1, dim == 3 ? 2.0 : 0.0}, flat{1, 1, dim == 3 ? 1.0 : 0.0};
    // u = L . r + (b . r)^2 a, its slope L + 2 (b . r) a b
    QuadraticFit fit(dim, 0.7);
    for (const Vec3& s : places) {
      const Vec3 r{s.x, s.y, dim == 3 ? s.z : 0};
      fit.add_value(r, dot(L, r) + dot(b, r) * dot(b, r) * a);
      fit.add_gradient(r, L + (2 * dot(b, r)) * outer(a, b));
    }
    const auto fitted = fit.gradient();
    ASSERT_TRUE(fitted);
    EXPECT_LE(norm(dot(*fitted, flat) - dot(L, flat)), 1e-12) << dim;
  }
}

// A conic through the cell and its five neighbours is a quadratic that vanishes in all of them:
// near one, what the fit makes of their velocities is arbitrary.
TEST(QuadraticFit, GivesNothingWhereItAmplifiesErrors) {
  const auto gradient_off_circle = [](Real off) {
    QuadraticFit fit(2, 1);
    for (const Real angle : {0.4, 1.3, 2.1, 4.0, 5.2}) {
      // on a circle through the cell
      const Vec3 r{std::cos(angle) - 1, std::sin(angle) + (angle > 5 ? off : 0), 0};
      fit.add_value(r, {r.x * r.x - 2 * r.x * r.y + 3 * r.y, 0, 0});
    }
    return fit.gradient();
  };
  EXPECT_FALSE(gradient_off_circle(0.0));
  EXPECT_FALSE(gradient_off_circle(0.02));
  const auto told = gradient_off_circle(1.2);
  ASSERT_TRUE(told);
  EXPECT_NEAR(told->xx, 0, 1e-10);
  EXPECT_NEAR(told->xy, 3, 1e-10);
}

}  // namespace
}  // namespace fsi
