// A velocity that is linear on either side of a plane surface, with a kink there.

#include "libfsi/solid/velocity_kink.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libfsi/flow/convection.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/solid/extension.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::solid {
namespace {

constexpr Real h = 1.0 / 12;
const Vec3 normal{std::cos(0.4), std::sin(0.4), 0}, jump{-std::sin(0.4), std::cos(0.4), 0};

/// The distance from the surface, positive in the fluid.
Real above(const Vec3& x, Real place) { return dot(x, normal) - place; }

Vec3 velocity(const Vec3& x, Real place) {
  const Vec3 smooth{0.3 + 0.2 * x.y, 0.1 - 0.7 * x.x, 0};
  return smooth + std::max(above(x, place), 0.0) * jump;
}

/// The surface at `place`, and that velocity, on squares.
struct Kinked {
  explicit Kinked(Real place)
      : mesh(test::read_box({.n = {12, 12, 0}})),
        stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), true)) {
    for (Index c = 0; c < mesh.n_cells; ++c) {
      u[c] = velocity(mesh.C[c], place);
      alpha[c] = std::clamp(0.5 - above(mesh.C[c], place) / h, 0.0, 1.0);
    }
    for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
      u_b[f - mesh.n_internal] = velocity(mesh.Cf[f], place);
    for (Index f = 0; f < mesh.n_internal; ++f) {
      const Real P = above(mesh.C[mesh.owner[f]], place), N = P + dot(mesh.d[f], normal);
      const Real line = std::max(P, N) - std::min(P, N);
      alpha_f[f] = line > 0 ? std::clamp(-std::min(P, N) / line, 0.0, 1.0) : P < 0 ? 1 : 0;
    }
    fsi::gradient(L, u, u_b, stencil, mesh);
    mesh.halo.update(L);
    band.rebuild(alpha, alpha_known);
  }
  Mesh mesh;
  FaceWeights weights{mesh};
  GradientStencil stencil;
  CellField<Vec3> u{mesh};
  BoundaryField<Vec3> u_b{mesh};
  CellField<Real> alpha{mesh};
  FaceField<Real> alpha_f{mesh};
  CellField<Tensor> L{mesh};
  SimplexZone zone{mesh};
  Band band{mesh};
};

TEST(VelocityKink, OfAPlaneSurfaceIsExactWhereverItLies) {
  for (const Real place : {0.61, 0.64, 0.66, 0.69}) {
    const Kinked kinked(place);
    const Mesh& mesh = kinked.mesh;
    Kinks kinks(mesh);
    add_kinks(kinks, {kinked.alpha_f, kinked.alpha, kinked.L}, kinked.zone, kinked.band, mesh);
    ASSERT_EQ(kinks.faces().size(), kinks.excess().size());
    Real worst = 0, without = 0;
    Index inner = 0;
    for (std::size_t i = 0; i < kinks.faces().size(); ++i) {
      const Index f = kinks.faces()[i], P = mesh.owner[f], N = mesh.neighbour[f];
      EXPECT_TRUE(crosses(kinked.alpha, f, mesh));
      const Vec3 x = mesh.Cf[f];
      if (std::min({x.x, x.y, 1 - x.x, 1 - x.y}) < 1.6 * h) continue;  // a gradient at the boundary
      const Vec3 mean = 0.5 * (kinked.u[P] + kinked.u[N]), exact = velocity(x, place);
      worst = std::max(worst, norm(mean + kinks.excess()[i] - exact));
      without = std::max(without, norm(mean - exact));
      ++inner;
    }
    EXPECT_GT(global_sum(inner), 5);
    EXPECT_LT(global_max(worst), 1e-14);
    EXPECT_GT(global_max(without), 0.05 * h);
  }
}

// With it convection has the exact velocity at all faces, and is that of a flow with a kink.
TEST(VelocityKink, ConvectionIsThatOfTheExactValues) {
  const Kinked kinked(0.64);
  const Mesh& mesh = kinked.mesh;
  Kinks kinks(mesh);
  add_kinks(kinks, {kinked.alpha_f, kinked.alpha, kinked.L}, kinked.zone, kinked.band, mesh);
  FaceField<Real> phi(mesh);
  for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = dot(Vec3{1, 0.5, 0}, mesh.Sf[f]);
  CellField<Vec3> conv(mesh), without(mesh);
  flow::convection(without, phi, kinked.u, kinked.u_b, {}, kinked.weights, mesh, false);
  conv.assign(without);
  flow::add_kinks(conv, phi, kinks, mesh);
  Real worst = 0, worst_without = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Vec3& x = mesh.C[c];
    if (std::min({x.x, x.y, 1 - x.x, 1 - x.y}) < 2.1 * h) continue;
    Vec3 exact;
    for (const Index f : mesh.cell_faces[c])
      exact += (mesh.owner[f] == c ? phi[f] : -phi[f]) * velocity(mesh.Cf[f], 0.64);
    worst = std::max(worst, norm(conv[c] - exact));
    worst_without = std::max(worst_without, norm(without[c] - exact));
  }
  EXPECT_LT(global_max(worst), 1e-15);
  EXPECT_GT(global_max(worst_without), 1e-3 * h);
}

// Where two surfaces pass the same face it counts once, with their mean.
TEST(VelocityKink, CountsAFaceOnce) {
  const Kinked kinked(0.64);
  Kinks kinks(kinked.mesh);
  const auto add = [&] {
    add_kinks(kinks, {kinked.alpha_f, kinked.alpha, kinked.L}, kinked.zone, kinked.band,
              kinked.mesh);
  };
  add();
  const std::size_t once = kinks.faces().size();
  add();
  EXPECT_EQ(kinks.faces().size(), once);
  const Vec3 first = kinks.excess().front();
  kinks.add(kinks.faces().front(), first + Vec3{2, 0, 0});
  EXPECT_LT(norm(kinks.excess().front() - first - Vec3{2.0 / 3, 0, 0}), 1e-15);  // of three
  kinks.clear();
  EXPECT_TRUE(kinks.faces().empty() && kinks.excess().empty());
  add();
  EXPECT_EQ(kinks.faces().size(), once);
}

}  // namespace
}  // namespace fsi::solid
