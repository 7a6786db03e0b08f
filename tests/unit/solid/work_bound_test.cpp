// The strain of the outermost cells against the work of the elastic force.

#include "libfsi/solid/work_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/flow/viscous.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/elastic_force.hpp"
#include "libfsi/solid/surface_traction.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

constexpr Tensor gradient_2d{0.3, -1.1, 0, 0.7, -0.3, 0, 0, 0, 0};
constexpr Tensor gradient_3d{0.3, -1.1, 0.4, 0.7, 0.2, -0.6, 0.9, 0.5, -0.5};

/// |t|, the root of t : t.
Real size(const Tensor& t) { return std::sqrt(trace(dot(t, transpose(t)))); }

/// Solid below y = top, whose surface cuts cells, and what a cell's strain is bounded by.
struct HalfSolid {
  HalfSolid(const test::BoxFile& box, Real surface)
      : top(surface),
        mesh(test::read_box(box)),
        weights(mesh),
        stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false)),
        alpha(mesh),
        alpha_f(mesh),
        normal(mesh, {0, 1, 0}),
        u(mesh),
        L(mesh),
        phi(mesh),
        known(mesh),
        extension(mesh) {
    const Real h = 1.0 / static_cast<Real>(box.n[1]);
    const auto part = [&](Real y) { return std::clamp((top - y) / h + 0.5, 0.0, 1.0); };
    for (Index c = 0; c < mesh.n_cells; ++c) alpha[c] = part(mesh.C[c].y);
    for (Index f = 0; f < mesh.n_faces; ++f) alpha_f[f] = part(mesh.Cf[f].y);
    known.rebuild(alpha, solid::alpha_known);
    extension.mark(alpha, known);
  }
  Tensor excess(const Tensor& of, Index c, Real in_series = 1) const {
    const solid::CutFaces cuts{alpha_f, normal, alpha};
    const solid::FlowSnapshot snapshot{.phi = phi,
                                       .u = u,
                                       .L = L,
                                       .stencil = stencil.cells,
                                       .weights = weights,
                                       .cuts = &cuts,
                                       .in_series = in_series};
    return solid::excess_of_work(of, snapshot, alpha, extension, mesh, c);
  }

  /// Elastic force of G = 1, and traction between viscosities 1 and ratio.
  CellField<Vec3> force(const CellField<SymTensor>& T, Real ratio) {
    CellField<Vec3> sum(mesh);
    FaceField<Real> source(mesh);
    CellField<solid::SymGradient> grad(mesh);
    Band band(mesh);
    band.rebuild(alpha, 1e-9);
    solid::ElasticForce law(mesh, weights, 1);
    law.apply(sum, source, {.T = T, .alpha = alpha, .alpha_f = &alpha_f, .normal = &normal},
              weights, stencil, band, grad);
    if (ratio == 1) return sum;
    FaceField<Real> mu(mesh);
    flow::mixture_viscosity(mu, alpha, 1, ratio, weights, mesh);
    const CellField<Vec3> n(mesh, {0, 1, 0});
    CellField<Real> height(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) height[c] = mesh.C[c].y - top;
    const std::vector<Tensor> L_f(weights.irregular.size());
    solid::SurfaceTraction traction(mesh, weights, 1, {.solid = ratio, .fluid = 1});
    traction.apply(sum, source, {u, L, L_f, T, alpha, alpha_f, normal, n, height, mu}, stencil,
                   band);
    return sum;
  }

  Real top;
  Mesh mesh;
  FaceWeights weights;
  PressureStencil stencil;
  CellField<Real> alpha;
  FaceField<Real> alpha_f;
  FaceField<Vec3> normal;
  CellField<Vec3> u;
  CellField<Tensor> L;
  FaceField<Real> phi;
  Band known;
  solid::Extension extension;
};

TEST(WorkBound, NoExcessInALinearFlow) {
  for (const bool simplex : {false, true})
    for (const Index depth : {0, 5}) {
      HalfSolid half({.n = {5, 5, depth}, .simplex = simplex}, 0.54);
      const Tensor L = depth == 0 ? gradient_2d : gradient_3d;
      half.L.fill(L);
      for (Index c = 0; c < half.mesh.n_cells; ++c) half.u[c] = dot(L, half.mesh.C[c]);
      Real worst = 0;
      for (Index c = 0; c < half.mesh.n_owned; ++c)
        worst = std::max(worst, size(half.excess(L, c)));
      EXPECT_LE(global_max(worst), 1e-12);
    }
}

// With the stress in one cell of the surface, and in the cell that goes on with it, the power of
// ElasticForce on any velocity is W T : excess(0), with that of the traction between two
// viscosities.
void expect_power_of_force(Index depth, Real ratio) {
  HalfSolid half({.n = {5, 10, depth}}, 0.67);
  const Mesh& mesh = half.mesh;
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Vec3 x = mesh.C[c];
    half.u[c] = {std::sin(31 * x.x + 17 * x.y), std::cos(13 * x.x * x.y), std::sin(7 * x.z)};
    if (mesh.dim == 2) half.u[c].z = 0;
  }
  const SymTensor T =
      mesh.dim == 2 ? SymTensor{.xx = 0.7, .xy = -0.4, .yy = -0.7}
                    : SymTensor{.xx = 0.7, .xy = -0.4, .xz = 0.2, .yy = 0.1, .yz = 0.5, .zz = -0.8};
  const auto of_column = [&](Index c) {
    const Vec3 x = mesh.C[c];
    return std::abs(x.x - 0.5) < 0.1 && (mesh.dim == 2 || std::abs(x.z - 0.5) < 0.1) && x.y > 0.6 &&
           x.y < 0.8;
  };
  CellField<SymTensor> stress(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c)
    if (of_column(c)) stress[c] = T;
  const CellField<Vec3> force = half.force(stress, ratio),
                        at_rest = half.force(CellField<SymTensor>(mesh), ratio);
  Sum taken, told;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    taken.add(-mesh.V[c] * dot(half.u[c], force[c] - at_rest[c]));
    if (of_column(c) && half.alpha[c] >= 0.5) {
      Real W = 0;
      for (const Index f : mesh.cell_faces[c]) {
        const Index n = beyond(mesh, f, c);
        const Real w = half.alpha[n] >= 0.5 ? 0.5 : 1;
        W += w * (half.alpha[c] + half.alpha[n]) / 2 * dot(mesh.d[f], mesh.Sf[f]) /
             static_cast<Real>(mesh.dim);
      }
      told.add(W * solid::power(T, half.excess({}, c, ratio)));
    }
  }
  EXPECT_NEAR(taken.total(), told.total(), 1e-12);
  EXPECT_GT(std::abs(told.total()), 1e-4);
}

TEST(WorkBound, IsThePowerOfTheForce) {
  for (const Index depth : {0, 5})
    for (const Real ratio : {1.0, 10.0, 0.5}) expect_power_of_force(depth, ratio);
}

TEST(WorkBound, TakesOutWhatIsMade) {
  constexpr SymTensor T{.xx = 0.7, .xy = -0.4, .xz = 0.2, .yy = 0.1, .yz = 0.5, .zz = -0.8};
  const Tensor L = gradient_3d, excess{-0.5, 0, 0, 0, 0.1, 0, 0, 0, 0.4};
  ASSERT_LT(solid::power(T, excess), 0);
  const Tensor bounded = solid::bound_by_work(L, excess, T);
  const Tensor D = 0.5 * (L + transpose(L)), t{0.7, -0.4, 0.2, -0.4, 0.1, 0.5, 0.2, 0.5, -0.8};
  const Real allowed = 0.1 * size(t) * size(D);
  EXPECT_NEAR(solid::power(T, bounded), solid::power(T, L + excess) + allowed, 1e-14);
  EXPECT_NEAR(trace(bounded), trace(L), 1e-14);
  EXPECT_EQ(solid::bound_by_work(L, -1.0 * excess, T), L);
  EXPECT_EQ(solid::bound_by_work(L, excess, {}), L);
}

}  // namespace
}  // namespace fsi
