#include "libfsi/vof/advect.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "libfsi/core/parallel.hpp"
#include "libfsi/vof/fill.hpp"
#include "tests/unit/support/box_file.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi::vof {
namespace {

/// An interface with all it takes to move it.
struct Moving {
  const Mesh& mesh;
  CellField<Real> alpha;
  FaceField<Real> phi;
  CellField<Vec3> u;
  Interface interface;
  ReconstructScratch reconstruct_scratch;
  AdvectScratch advect_scratch;
  AdvectReport report;

  explicit Moving(const Mesh& m)
      : mesh(m), alpha(m), phi(m), u(m), interface(m), reconstruct_scratch(m), advect_scratch(m) {}

  void flow(const Vec3& velocity) {
    u.fill(velocity);
    for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = dot(velocity, mesh.Sf[f]);
  }
  void step(Real dt) {
    reconstruct(interface, alpha, mesh, reconstruct_scratch);
    report = advect(alpha, interface, phi, u, dt, mesh, advect_scratch);
  }
  Real volume() const {
    Sum sum;
    for (Index c = 0; c < mesh.n_owned; ++c) sum.add(alpha[c] * mesh.V[c]);
    return sum.total();
  }
  /// Largest excess over [0, 1].
  Real excess() const {
    Real worst = 0;
    for (Index c = 0; c < mesh.n_owned; ++c) worst = std::max({worst, alpha[c] - 1, -alpha[c]});
    return global_max(worst);
  }
};

TEST(Advect, ASlabInUniformFlowIsExact) {
  for (const Index nz : {0, 4}) {
    const Mesh mesh = test::box_mesh(
        {.n = {20, 4, nz}, .length = {1, 0.2, 0.2}, .periodic = {true, true, nz > 0}});
    Moving m(mesh);
    const auto slab = [&](Real from, Real to) {  // exact fractions, 0 < from < to < 1
      CellField<Real> a(mesh);
      for (Index c = 0; c < mesh.n_cells; ++c) {
        const Real low = mesh.C[c].x - 0.025, high = mesh.C[c].x + 0.025;
        a[c] = std::max(0.0, std::min(high, to) - std::max(low, from)) / 0.05;
      }
      return a;
    };
    m.alpha = slab(0.213, 0.468);
    m.flow({1, 0, 0});
    for (int i = 0; i < 16; ++i) m.step(0.025);  // Courant number 0.5
    const CellField<Real> exact = slab(0.613, 0.868);
    for (Index c = 0; c < mesh.n_cells; ++c) EXPECT_NEAR(m.alpha[c], exact[c], 2e-14);
  }
}

TEST(Advect, AnObliqueSlabKeepsItsShape) {
  // The interface lies along (1, 1): across it the fractions repeat, over the seams too.
  const Mesh mesh =
      test::read_box({{16, 16, 0}, {1, 1, 1}, false, {"left", "right", "bottom", "top"}});
  Moving m(mesh);
  const Vec3 n = Vec3{1, -1, 0} / std::sqrt(2.0);
  const auto band = [&](Real offset) {
    CellField<Real> a(mesh);
    geometry::Polytope cell(2);
    for (Index c = 0; c < mesh.n_owned; ++c) {
      gather(cell, mesh, c);
      for (int k = -2; k <= 2; ++k) {  // 0.31 < x - y - offset < 0.72 modulo 1
        const auto below = [&](Real s) {
          return geometry::measure_below(cell, {n, s / std::sqrt(2.0) - dot(n, mesh.C[c])});
        };
        a[c] += (below(0.72 + offset + k) - below(0.31 + offset + k)) / mesh.V[c];
      }
    }
    mesh.halo.update(a);
    return a;
  };
  m.alpha = band(0);
  m.flow({1, 0.25, 0});
  const Real volume = m.volume();
  for (int i = 0; i < 40; ++i) m.step(0.025);
  const CellField<Real> exact = band(0.75);
  Sum error;
  for (Index c = 0; c < mesh.n_owned; ++c) error.add(std::abs(m.alpha[c] - exact[c]) * mesh.V[c]);
  const Real e = error.total();
  if (rank() == 0) std::printf("oblique band: shape error %.1e\n", e);
  // Not zero: what enters an empty cell and leaves it within the same step is left behind.
  EXPECT_LE(e, 1e-4);
  EXPECT_NEAR(m.volume(), volume, 1e-14);
}

/// A disc (ball) carried once through a periodic box of any cells: bounds and volume are kept, on
/// the way over every seam.
TEST(Advect, ThroughAPeriodicBox) {
  for (const Index nz : {0, 10}) {
    for (const bool simplex : {false, true}) {
      std::vector<std::string> pairs{"left", "right", "bottom", "top"};
      if (nz > 0) pairs.insert(pairs.end(), {"back", "front"});
      const Mesh mesh = test::read_box({{10, 10, nz}, {1, 1, 1}, simplex, pairs});
      Moving m(mesh);
      fill(m.alpha, mesh, shapes::translate(shapes::sphere(0.3), {0.41, 0.53, nz > 0 ? 0.47 : 0}));
      CellField<Real> start(mesh);
      start.assign(m.alpha);
      m.flow({1, 1, nz > 0 ? 1.0 : 0.0});
      const Real volume = m.volume();
      Real worst = 0;
      const int steps = simplex ? 160 : 80;
      for (int i = 0; i < steps; ++i) {
        m.step(1.0 / steps);
        worst = std::max(worst, m.excess());
        ASSERT_LE(m.report.remaining, 1e-12);
      }
      EXPECT_LE(worst, 1e-12);
      EXPECT_NEAR(m.volume() / volume, 1, 1e-13);
      Sum error;
      for (Index c = 0; c < mesh.n_owned; ++c)
        error.add(std::abs(m.alpha[c] - start[c]) * mesh.V[c]);
      const Real e = error.total() / volume;
      if (rank() == 0) {
        std::printf("once around: %dD %s relative shape error %.2e\n", mesh.dim,
                    simplex ? "simplices" : "boxes", e);
      }
      EXPECT_LE(e, 0.12);  // the radius is three cells
    }
  }
}

TEST(Advect, TheSolidFluxClosesTheBalance) {
  const Mesh mesh = test::read_box({{8, 8, 8}, {1, 1, 1}, true});
  Moving m(mesh);
  fill(m.alpha, mesh, shapes::translate(shapes::sphere(0.3), {0.45, 0.5, 0.5}));
  m.flow({1, 0.2, 0.1});
  CellField<Real> before(mesh);
  before.assign(m.alpha);
  m.step(0.01);
  Real worst = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Real out = 0;
    for (const Index f : mesh.cell_faces[c])
      out += (mesh.owner[f] == c ? 1 : -1) * m.advect_scratch.solid[f];
    worst = std::max(worst, std::abs(before[c] - out / mesh.V[c] - m.alpha[c]));
  }
  EXPECT_LE(global_max(worst), 1e-12);
}

/// A flux with divergence: full cells stay full, bounds hold, the volume of the solid is kept.
TEST(Advect, DivergenceNeitherFillsNorDrainsTheSolid) {
  const Mesh mesh = test::read_box({{16, 16, 0}});
  Moving m(mesh);
  fill(m.alpha, mesh, shapes::translate(shapes::sphere(0.3), {0.5, 0.5, 0}));
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Vec3& x = mesh.C[c];
    m.u[c] = {-x.y + 0.5, x.x - 0.5, 0};
  }
  const auto inside = [&](Index c) { return norm(mesh.C[c] - Vec3{0.5, 0.5, 0}) < 0.15; };
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const Vec3& x = mesh.Cf[f];
    m.phi[f] = dot(Vec3{-x.y + 0.5, x.x - 0.5, 0}, mesh.Sf[f]);
    m.phi[f] += 1e-6 * std::sin(1e4 * x.x + 3e4 * x.y) * norm(mesh.Sf[f]);
  }
  const Real volume = m.volume();
  for (int i = 0; i < 50; ++i) {
    m.step(0.02);
    ASSERT_NEAR(m.volume() / volume, 1, 1e-13);
    ASSERT_LE(m.excess(), 1e-12);
  }
  EXPECT_GT(m.report.returned, 0);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (inside(c)) {
      EXPECT_EQ(m.alpha[c], 1);
    }
  }
}

TEST(Advect, SolidLeavesThroughTheBoundary) {
  const Mesh mesh = test::read_box({{10, 4, 0}, {1, 0.4, 1}});
  Moving m(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) m.alpha[c] = mesh.C[c].x > 0.5 ? 1 : 0;
  m.flow({1, 0, 0});
  for (int i = 0; i < 8; ++i) {
    const Real before = m.volume();
    m.step(0.05);
    ASSERT_NEAR(m.volume(), before - 0.05 * 0.4, 1e-15);
  }
  for (int i = 0; i < 4; ++i) m.step(0.05);
  EXPECT_EQ(m.volume(), 0);
}

TEST(Advect, NothingToMoveCostsNothing) {
  const Mesh mesh = test::read_box({{6, 6, 0}});
  Moving m(mesh);
  m.flow({1, 0, 0});
  m.step(0.05);
  EXPECT_EQ(m.volume(), 0);
  EXPECT_TRUE(m.advect_scratch.faces.empty());
}

}  // namespace
}  // namespace fsi::vof
