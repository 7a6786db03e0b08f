// The projection: no divergence is left, gradients of linear pressures are exact.

#include "libfsi/flow/projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "libfsi/core/error.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::flow {
namespace {

/// A box with walls, its ends open or not.
struct Channel {
  Channel(const test::BoxFile& box, bool open)
      : mesh(test::read_box(box)),
        weights(mesh),
        projection(mesh, weights,
                   resolve({{"left", open ? Condition(Opening{}) : Condition(Wall{})},
                            {"right", open ? Condition(Opening{}) : Condition(Wall{})},
                            {"top", Wall{}},
                            {"bottom", Wall{}}},
                           mesh),
                   Method::direct, 20),
        q(mesh),
        grad(mesh),
        q_b(mesh) {}

  Mesh mesh;
  FaceWeights weights;
  Projection projection;
  CellField<Real> q;
  CellField<Vec3> grad;
  BoundaryField<Real> q_b;
};

const test::BoxFile squares{.n = {8, 8, 0}};
const test::BoxFile crooked{
    .n = {8, 8, 0}, .moved = [](const Vec3& x) {
      const Real inside = x.x * (1 - x.x) * x.y * (1 - x.y);
      return x + (0.4 * inside * std::sin(9 * x.x + 7 * x.y)) * Vec3{1, -1, 0};
    }};

TEST(Projection, LeavesNoDivergence) {
  for (const auto& box : {squares, crooked})
    for (const bool open : {false, true}) {
      Channel channel(box, open);
      const Mesh& mesh = channel.mesh;
      FaceField<Real> phi(mesh);
      for (Index f = 0; f < mesh.n_internal; ++f)
        phi[f] = dot(Vec3{std::sin(5 * mesh.Cf[f].x), mesh.Cf[f].x, 0}, mesh.Sf[f]);
      EXPECT_GT(divergence_max(phi, mesh), 0.1);
      channel.projection.project(phi, channel.q, channel.grad, channel.q_b, 1e-14);
      EXPECT_LT(divergence_max(phi, mesh), 1e-10) << open;
    }
}

TEST(Projection, GradientOfALinearPressureIsExact) {
  const Vec3 slope{2, -3, 0};
  for (const auto& box : {squares, crooked})
    for (const bool open : {false, true}) {
      Channel channel(box, open);
      const Mesh& mesh = channel.mesh;
      for (Index c = 0; c < mesh.n_cells; ++c) channel.q[c] = dot(slope, mesh.C[c]);
      for (Index b = 0; b < mesh.n_boundary(); ++b)
        channel.q_b[b] = dot(slope, mesh.Cf[mesh.n_internal + b]);
      channel.projection.set_gradient(channel.grad, channel.q, channel.q_b);
      Real worst = 0;
      for (Index c = 0; c < mesh.n_cells; ++c)
        worst = std::max(worst, norm(channel.grad[c] - slope));
      EXPECT_LT(global_max(worst), 1e-11) << open;
    }
}

// Lap q = 0 between q = 0 and q = 1: q = x takes off the flux of a unit velocity.
TEST(Projection, PressuresOfOpenings) {
  Channel channel(squares, true);
  const Mesh& mesh = channel.mesh;
  FaceField<Real> phi(mesh);
  for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = mesh.Sf[f].x;
  for (Index b = 0; b < mesh.n_boundary(); ++b)
    channel.q_b[b] = mesh.Cf[mesh.n_internal + b].x > 0.999 ? 1 : 0;
  channel.projection.project(phi, channel.q, channel.grad, channel.q_b, 1e-14);
  Real worst = 0;
  for (Index c = 0; c < mesh.n_cells; ++c)
    worst = std::max(
        {worst, norm(channel.grad[c] - Vec3{1, 0, 0}), std::abs(channel.q[c] - mesh.C[c].x)});
  for (Index f = 0; f < mesh.n_faces; ++f) worst = std::max(worst, std::abs(phi[f]));
  EXPECT_LT(global_max(worst), 1e-12);
}

// The iterations of the orthogonal projection end with an error where the flux is no number.
TEST(Projection, OrthogonalOneRefusesAFluxThatIsNoNumber) {
  Channel channel(crooked, false);
  const Mesh& mesh = channel.mesh;
  const GradientStencil stencil(mesh, channel.weights,
                                std::vector<bool>(mesh.patches.size(), true));
  channel.projection.make_orthogonal(
      stencil,
      resolve({{"left", Wall{}}, {"right", Wall{}}, {"top", Wall{}}, {"bottom", Wall{}}}, mesh));
  FaceField<Real> phi(mesh);
  for (Index f = 0; f < mesh.n_internal; ++f) phi[f] = mesh.Cf[f].x * mesh.Sf[f].x;
  EXPECT_NO_THROW(channel.projection.project(phi, channel.q, channel.grad, channel.q_b, 1e-14));
  phi.fill(std::numeric_limits<Real>::quiet_NaN());
  EXPECT_THROW(channel.projection.project(phi, channel.q, channel.grad, channel.q_b, 1e-14), Error);
}

}  // namespace
}  // namespace fsi::flow
