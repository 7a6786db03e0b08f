// The velocity gradient without the divergence that cell velocities keep.

#include "libfsi/solid/solenoidal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

constexpr Tensor G{0.3, -1.1, 0.4, 0.7, 0.2, -0.6, 0.9, 0.5, -0.5};  // trace 0

Real difference(const Tensor& a, const Tensor& b) {
  const Tensor d = a + -1.0 * b;
  return std::max({std::abs(d.xx), std::abs(d.xy), std::abs(d.xz), std::abs(d.yx), std::abs(d.yy),
                   std::abs(d.yz), std::abs(d.zx), std::abs(d.zy), std::abs(d.zz)});
}

bool inside(const Vec3& x, int dim) {
  const auto away = [](Real a) { return std::abs(a - 0.5) < 0.3; };
  return away(x.x) && away(x.y) && (dim == 2 || away(x.z));
}

Tensor gradient_of(int dim) {
  Tensor L = G;
  if (dim == 2) L.xz = L.yz = L.zx = L.zy = L.zz = 0, L.yy = -L.xx;
  return L;
}

// On irregular quads and hexes: a linear velocity and its flux leave the gradient as it is.
TEST(Solenoidal, KeepsALinearField) {
  for (const Index depth : {0, 6}) {
    test::BoxFile box{.n = {6, 6, depth}};
    box.moved = [](const Vec3& x) {
      return x + (0.1 * std::sin(9 * x.y + 5 * x.z) * x.x * (1 - x.x)) * Vec3{1, 0, 0};
    };
    const Mesh mesh = test::read_box(box);
    const FaceWeights weights(mesh);
    EXPECT_FALSE(weights.irregular.empty());
    const GradientStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false));
    const Tensor exact = gradient_of(mesh.dim);
    CellField<Vec3> u(mesh);
    CellField<Tensor> L(mesh, exact);
    FaceField<Real> phi(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) u[c] = dot(exact, mesh.C[c]);
    for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = dot(dot(exact, mesh.Cf[f]), mesh.Sf[f]);
    const solid::FlowSnapshot snapshot{phi, u, L, stencil, weights};
    Real worst = 0;
    for (Index c = 0; c < mesh.n_owned; ++c)
      if (inside(mesh.C[c], mesh.dim))
        worst =
            std::max(worst, difference(solid::flux_consistent_gradient(snapshot, mesh, c), exact));
    EXPECT_LE(global_max(worst), 1e-11);
    const CellField<Real> solid_everywhere(mesh, 1);
    for (Index c = 0; c < mesh.n_owned; ++c)
      EXPECT_LE(norm(solid::velocity_of_fluxes(snapshot, solid_everywhere, mesh, c) - u[c]), 1e-12);
  }
}

// Solid at x < 1/2, what is not known beyond; cell velocities that the flux does not have: gone
// where all faces are the solid's, half of what crosses the surface stays beside it.
TEST(Solenoidal, VelocityOfTheFluxes) {
  for (const Index depth : {0, 6}) {
    const Mesh mesh = test::read_box({.n = {6, 6, depth}});
    const FaceWeights weights(mesh);
    const GradientStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false));
    CellField<Real> alpha(mesh);
    CellField<Vec3> u(mesh, {9, 9, 9});
    for (Index c = 0; c < mesh.n_cells; ++c)
      if (mesh.C[c].x < 0.5) alpha[c] = 1, u[c] = {2, 4, mesh.dim == 3 ? 6.0 : 0.0};
    const FaceField<Real> phi(mesh);  // at rest
    const CellField<Tensor> L(mesh);
    const solid::FlowSnapshot snapshot{phi, u, L, stencil, weights};
    for (Index c = 0; c < mesh.n_owned; ++c) {
      if (!inside(mesh.C[c], mesh.dim) || alpha[c] == 0) continue;
      const bool at_surface = std::abs(mesh.C[c].x - 0.5) < 0.1;
      EXPECT_LE(norm(solid::velocity_of_fluxes(snapshot, alpha, mesh, c) -
                     Vec3{at_surface ? 1.0 : 0.0, 0, 0}),
                1e-12);
    }
  }
}

// On squares what the cell velocities have too much along x, and the flux has not, goes; what
// differs along y of it stays.
TEST(Solenoidal, TakesTheFluxForTheNormalVelocity) {
  const Mesh mesh = test::read_box({.n = {8, 8, 0}});
  const FaceWeights weights(mesh);
  const GradientStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false));
  CellField<Vec3> u(mesh);
  FaceField<Real> phi(mesh);  // at rest
  CellField<Tensor> L(mesh, Tensor{2, 3, 0, 0, 0, 0, 0, 0, 0});
  for (Index c = 0; c < mesh.n_cells; ++c) u[c] = {2 * mesh.C[c].x + 3 * mesh.C[c].y, 0, 0};
  const solid::FlowSnapshot snapshot{phi, u, L, stencil, weights};
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (!inside(mesh.C[c], mesh.dim)) continue;
    EXPECT_LE(
        difference(solid::flux_consistent_gradient(snapshot, mesh, c), {0, 3, 0, 0, 0, 0, 0, 0, 0}),
        1e-12);
  }
}

// At a plane surface x = 1/2: L_xx alone is changed, whatever makes the trace.
TEST(Solenoidal, TakesTheTraceOutAlongTheNormal) {
  for (const Index depth : {0, 6}) {
    const Mesh mesh = test::read_box({.n = {6, 6, depth}});
    CellField<Real> alpha(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) alpha[c] = mesh.C[c].x < 0.5 ? 1 : 0;
    Tensor L = G;
    L.yy += 2;
    Tensor expected = L;
    expected.xx = -L.yy - L.zz;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      if (!inside(mesh.C[c], mesh.dim)) continue;
      const bool at_surface = std::abs(mesh.C[c].x - 0.5) < 0.1;
      EXPECT_LE(
          difference(solid::remove_normal_divergence(L, alpha, mesh, c), at_surface ? expected : L),
          1e-12);
    }
  }
}

}  // namespace
}  // namespace fsi
