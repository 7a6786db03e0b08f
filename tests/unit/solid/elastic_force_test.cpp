// Elastic stress, its force and the balance of the face flux.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/io/layout.hpp"
#include "libfsi/solid/elastic_force.hpp"
#include "libfsi/solid/semi_implicit.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

constexpr Real G = 3;

/// Everything the law reads and writes on one mesh.
struct Solid {
  explicit Solid(const test::BoxFile& box)
      : mesh(test::read_box(box)),
        weights(mesh),
        stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false)),
        alpha(mesh, 1),
        B(mesh, identity()),
        force(mesh),
        rhie_chow_source(mesh),
        band(mesh),
        law(mesh, weights, G),
        grad(mesh) {}

  void apply() {
    force.fill({}), rhie_chow_source.fill(0);
    band.rebuild(alpha, 0.1);
    law.apply(force, rhie_chow_source, {B, alpha}, weights, stencil, band, grad);
  }
  /// Owned cells that have, as their neighbours have, enough neighbours for a gradient: a simplex
  /// with two boundary faces has not.
  std::vector<Index> fitted() const {
    CellField<Real> few(mesh);
    for (Index c = 0; c < mesh.n_owned; ++c) {
      int inside = 0;
      for (const Index f : mesh.cell_faces[c]) inside += f < mesh.n_internal ? 1 : 0;
      few[c] = inside < mesh.dim ? 1 : 0;
    }
    mesh.halo.update(few);
    std::vector<Index> cells;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      Real sum = few[c];
      for (const Index n : mesh.cell_neighbours[c]) sum += few[n];
      if (sum == 0) cells.push_back(c);
    }
    return cells;
  }
  /// Sum of force times volume over all ranks.
  Vec3 total() const {
    Sum x, y, z;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      x.add(mesh.V[c] * force[c].x), y.add(mesh.V[c] * force[c].y), z.add(mesh.V[c] * force[c].z);
    }
    return {x.total(), y.total(), z.total()};
  }

  Mesh mesh;
  FaceWeights weights;
  PressureStencil stencil;
  CellField<Real> alpha;
  CellField<SymTensor> B;
  CellField<Vec3> force;
  FaceField<Real> rhie_chow_source;
  Band band;
  solid::ElasticForce law;
  CellField<solid::SymGradient> grad;
};

/// Boxes of every kind of cell, the simplices moved off the lattice.
std::vector<test::BoxFile> boxes() {
  const auto moved = [](const Vec3& x) {
    const Real s = 0.03 * std::sin(7 * x.x + 3 * x.y) * std::cos(5 * x.y + 2 * x.z);
    return Vec3{x.x + s, x.y - s, x.z == 0 ? 0 : x.z + s};
  };
  return {{.n = {10, 10, 0}},
          {.n = {10, 10, 0}, .simplex = true, .moved = moved},
          {.n = {6, 6, 6}},
          {.n = {6, 6, 6}, .simplex = true, .moved = moved}};
}

TEST(ElasticForce, TheUndeformedSolidPullsNowhere) {
  for (const test::BoxFile& box : boxes()) {
    Solid s(box);
    for (Index c = 0; c < s.mesh.n_cells; ++c)
      s.alpha[c] = 0.5 + 0.5 * std::sin(10 * s.mesh.C[c].x * s.mesh.C[c].y);
    for (Index c = 0; c < s.mesh.n_cells; ++c) s.B[c] = identity();
    s.apply();
    for (Index c = 0; c < s.mesh.n_cells; ++c) ASSERT_LE(norm(s.force[c]), 1e-13);
    for (Index f = 0; f < s.mesh.n_faces; ++f) ASSERT_LE(std::abs(s.rhie_chow_source[f]), 1e-13);
  }
}

// A traceless linear alpha B: tau = G alpha B, div tau is the same everywhere.
TEST(ElasticForce, LinearStressIsExact) {
  for (const test::BoxFile& box : boxes()) {
    Solid s(box);
    const bool space = s.mesh.dim == 3;
    for (Index c = 0; c < s.mesh.n_cells; ++c) {
      const Vec3 x = s.mesh.C[c];
      s.B[c] = {2 * x.x + x.y, 3 * x.y - x.x, space ? x.z : 0, x.y, space ? 2 * x.x : 0, 0};
      s.B[c].zz = -s.B[c].xx - s.B[c].yy;
    }
    s.apply();
    // dx tau_xx + dy tau_xy + dz tau_xz = 2 + 3 + 1, dx tau_xy + dy tau_yy = -1 + 1,
    // dx tau_xz + dy tau_yz + dz tau_zz = 0
    const Vec3 exact = G * Vec3{space ? 6.0 : 5.0, 0, 0};
    for (const Index c : s.fitted()) {
      ASSERT_LE(norm(s.force[c] - exact), 1e-11) << "dim " << s.mesh.dim;
      for (const Index f : s.mesh.cell_faces[c]) ASSERT_LE(std::abs(s.rhie_chow_source[f]), 1e-12);
    }
  }
}

// Action = reaction: the force of a solid that touches no wall sums to zero.
TEST(ElasticForce, TheForceOfAClosedSolidSumsToZero) {
  for (const test::BoxFile& box : boxes()) {
    Solid s(box);
    for (Index c = 0; c < s.mesh.n_cells; ++c) {
      const Vec3 x = s.mesh.C[c] - Vec3{0.5, 0.5, s.mesh.dim == 3 ? 0.5 : 0};
      s.alpha[c] = norm(x) < 0.25 ? 1 : 0;
      s.B[c] = SymTensor{2, std::sin(20 * x.x), 0, 1 + x.y, x.z, 0.5};
    }
    s.apply();
    Real scale = 0;
    for (Index c = 0; c < s.mesh.n_owned; ++c) scale = std::max(scale, norm(s.force[c]));
    EXPECT_GT(global_max(scale), 1);
    EXPECT_LE(norm(s.total()), 1e-12);
  }
}

// A stress that is the same in all directions of the plane, ending at a surface, is the force of a
// pressure alpha s: differenced like one, whatever part of each face is solid, it is balanced by
// one to round-off, in the cells and in the face flux.
TEST(ElasticForce, ALevelStressIsBalancedByAPressure) {
  for (const test::BoxFile& box : boxes()) {
    if (box.n[2] > 0) continue;
    Solid s(box);
    FaceField<Real> part(s.mesh);
    FaceField<Vec3> normal(s.mesh);
    for (Index c = 0; c < s.mesh.n_cells; ++c) {
      s.alpha[c] = std::clamp(3 - 10 * norm(s.mesh.C[c] - Vec3{0.5, 0.5, 0}), 0.0, 1.0);
      s.B[c] = {2, 0, 0, 2, 0, 0.5};
    }
    for (Index f = 0; f < s.mesh.n_faces; ++f) {
      part[f] = 0.5 + 0.5 * std::sin(9 * s.mesh.Cf[f].x + 5 * s.mesh.Cf[f].y);
      normal[f] = {0.6, 0.8, 0};
    }
    s.band.rebuild(s.alpha, 1e-9);
    s.law.apply(s.force, s.rhie_chow_source, {s.B, s.alpha, &part, &normal}, s.weights, s.stencil,
                s.band, s.grad);
    CellField<Real> p(s.mesh);
    for (Index c = 0; c < s.mesh.n_cells; ++c) p[c] = G * 0.5 * s.alpha[c];  // dev B = 1/2
    CellField<Vec3> grad_p(s.mesh);
    const BoundaryField<Real> zero(s.mesh);
    std::vector<Vec3> at_faces(s.weights.irregular.size());
    gradient(grad_p, p, zero, s.stencil.cells, s.mesh);
    s.stencil.at_faces.set(at_faces, grad_p);
    pressure_gradient(grad_p, at_faces, p, zero, s.stencil.cells, s.mesh);
    for (Index c = 0; c < s.mesh.n_owned; ++c) ASSERT_LE(norm(s.force[c] - grad_p[c]), 1e-12);
    for (Index f = 0; f < s.mesh.n_internal; ++f) {
      const Index P = s.mesh.owner[f], N = s.mesh.neighbour[f];
      const Real lambda = s.weights.lambda[f];
      Real along = dot(lambda * grad_p[P] + (1 - lambda) * grad_p[N], s.mesh.Sf[f]);
      if (const Index i = s.weights.place[f]; i >= 0) along -= dot(at_faces[i], s.weights.k[f]);
      ASSERT_NEAR(s.rhie_chow_source[f], p[N] - p[P] - along / s.weights.g[f], 1e-12);
    }
  }
}

// Both ranks of a face give its flux the same balance, bit for bit, also at the rim of the band,
// where cells with a trace of solid have a part of the jump: else a checkpoint, which keeps one of
// the two, is not the state.
TEST(ElasticForce, BothRanksOfAFaceBalanceItAlike) {
  for (const test::BoxFile& box : boxes()) {
    Solid s(box);
    FaceField<Real> part(s.mesh, 0.5), owners(s.mesh);
    FaceField<Vec3> normal(s.mesh, {0.6, 0.8, 0});
    constexpr Real threshold = 1e-9;
    for (Index c = 0; c < s.mesh.n_cells; ++c) {
      const Vec3 x = s.mesh.C[c];
      const Real trace = threshold * (0.5 + 0.2 * std::sin(20 * x.x + 30 * x.y));
      s.alpha[c] = norm(x - Vec3{0.5, 0.5, s.mesh.dim == 2 ? 0 : 0.5}) < 0.25 ? 1 : trace;
    }
    s.band.rebuild(s.alpha, threshold);
    for (Index c = 0; c < s.mesh.n_cells; ++c)
      s.B[c] = s.band.listed()[c] * SymTensor{2, s.mesh.C[c].x, 0, 1 + s.mesh.C[c].y, 0, 0.5};
    s.law.apply(s.force, s.rhie_chow_source, {s.B, s.alpha, &part, &normal}, s.weights, s.stencil,
                s.band, s.grad);
    const io::Layout layout(s.mesh, Location::faces);
    std::vector<Real> room;
    layout.scatter(layout.gather(s.rhie_chow_source.data(), 1, room), 1, owners.data());
    EXPECT_TRUE(all_of_ranks(std::ranges::equal(s.rhie_chow_source.all(), owners.all())));
  }
}

// An alternating normal stress has no averaged gradient: the balance is the whole difference.
TEST(ElasticForce, TheBalanceSeesAnAlternatingStress) {
  Solid s({.n = {8, 8, 0}, .periodic = {"left", "right", "bottom", "top"}});
  const auto sign = [&](Index c) {
    return std::lround(8 * s.mesh.C[c].x - 0.5) % 2 == 0 ? 1.0 : -1.0;
  };
  for (Index c = 0; c < s.mesh.n_cells; ++c) s.B[c] = sign(c) * SymTensor{1, 0, 0, -1, 0, 0};
  s.apply();
  for (Index f = 0; f < s.mesh.n_internal; ++f) {
    const Index P = s.mesh.owner[f];
    const bool across = std::abs(s.mesh.Sf[f].x) > 0;
    EXPECT_NEAR(s.rhie_chow_source[f], across ? -2 * G * sign(P) : 0, 1e-12);
  }
  for (Index c = 0; c < s.mesh.n_cells; ++c) EXPECT_LE(norm(s.force[c]), 1e-12);
}

// Where the solid has left, nothing of its force stays.
// The force depends on the state alone, also in the cells around the band, which the outermost
// faces of a skewed mesh push at.
TEST(ElasticForce, TheForceIsTheSameAgain) {
  for (test::BoxFile box : boxes()) {
    box.moved = boxes()[1].moved;
    Solid s(box);
    for (Index c = 0; c < s.mesh.n_cells; ++c) {
      s.alpha[c] = norm(s.mesh.C[c] - Vec3{0.5, 0.5, s.mesh.dim == 2 ? 0 : 0.5}) < 0.25 ? 1 : 0;
      s.B[c] = SymTensor{s.mesh.C[c].x * s.mesh.C[c].y, 1, 0, 2, 0, 1};
    }
    s.apply();
    std::vector<Vec3> first(s.force.all().begin(), s.force.all().end());
    s.apply();
    for (Index c = 0; c < s.mesh.n_cells; ++c) ASSERT_EQ(norm(s.force[c] - first[c]), 0);
  }
}

TEST(ElasticForce, LeavesNothingBehind) {
  Solid s({.n = {8, 8, 0}});
  for (Index c = 0; c < s.mesh.n_cells; ++c)
    s.B[c] = SymTensor{s.mesh.C[c].x * s.mesh.C[c].y, 1, 0, 2, 0, 1};
  s.apply();
  s.alpha.fill(0);
  s.B.fill({});
  s.apply();
  for (Index c = 0; c < s.mesh.n_cells; ++c) ASSERT_EQ(norm(s.force[c]), 0);
  for (Index f = 0; f < s.mesh.n_faces; ++f) ASSERT_EQ(s.rhie_chow_source[f], 0);
}

// h (rho / (G lambda))^(1/2); the largest eigenvalue of a sheared B.
TEST(SemiImplicitElasticity, TimeOfTheElasticWave) {
  Solid s({.n = {10, 10, 0}});
  s.apply();
  const Real rho = 2, h = 0.1;
  CellField<Real> lambda(s.mesh);
  const auto widths = solid::wave_widths(s.mesh, solid::WaveWidth::own);
  const auto time = [&] {
    for (const Index c : s.band.core()) lambda[c] = eigen(s.B[c]).value[2];
    return global_min(solid::elastic_time(lambda, G, rho, widths, s.band.core()));
  };
  EXPECT_NEAR(time(), h * std::sqrt(rho / G), 1e-14);
  s.B.fill({2, 1, 0, 1, 0, 1});  // g = 1: lambda = (3 + sqrt 5) / 2
  EXPECT_NEAR(time(), h * std::sqrt(rho / G / (1.5 + std::sqrt(1.25))), 1e-14);
  EXPECT_EQ(solid::elastic_time(lambda, 0, rho, widths, s.band.core()),
            std::numeric_limits<Real>::max());
}

}  // namespace
}  // namespace fsi
