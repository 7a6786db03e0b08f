#include "libfsi/flow/wall_parabola.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/support/box_file.hpp"

namespace fsi::flow {
namespace {

/// Walls below and above, openings at the other sides.
std::vector<Condition> channel(const Mesh& mesh) {
  Conditions conditions{
      {"left", Opening{}}, {"right", Opening{}}, {"bottom", Wall{}}, {"top", Wall{}}};
  if (mesh.dim == 3) conditions.insert({{"back", Slip{}}, {"front", Slip{}}});
  return resolve(conditions, mesh);
}

GradientStencil stencil_of(const Mesh& mesh, const FaceWeights& weights) {
  std::vector<bool> given;
  for (const Condition& condition : channel(mesh)) given.push_back(!fixes_pressure(condition));
  return {mesh, weights, given};
}

/// The cells grow by the distance from the bottom.
Vec3 graded(const Vec3& x) { return {x.x, x.y * (1 + x.y) / 2, x.z}; }

TEST(WallParabola, IsExactForAParabola) {
  for (const Index nz : {0, 4})
    for (const bool uneven : {false, true}) {
      test::BoxFile box{.n = {6, 8, nz}};
      if (uneven) box.moved = graded;
      const Mesh mesh = test::read_box(box);
      const FaceWeights weights(mesh);
      const GradientStencil stencil = stencil_of(mesh, weights);
      const WallParabola parabola(mesh, channel(mesh), stencil);
      CellField<Vec3> u(mesh);
      BoundaryField<Vec3> u_b(mesh);
      const auto profile = [](const Vec3& x) { return Vec3{1 + 2 * x.y + 3 * x.y * x.y, x.y, 0}; };
      for (Index c = 0; c < mesh.n_cells; ++c) u[c] = profile(mesh.C[c]);
      for (Index b = 0; b < mesh.n_boundary(); ++b) u_b[b] = profile(mesh.Cf[mesh.n_internal + b]);
      for (std::size_t i = 0; i < parabola.walls().size(); ++i) {
        const Index b = parabola.walls()[i], f = mesh.n_internal + b;
        const bool top = mesh.Cf[f].y > 0.5;
        const Vec3 exact = (top ? 1 : -1) * norm(mesh.Sf[f]) * Vec3{top ? 8.0 : 2.0, 1, 0};
        const Vec3 difference = weights.g[f] * (u_b[b] - u[mesh.owner[f]]);
        EXPECT_NEAR(norm(difference + parabola.excess(i, u, u_b) - exact), 0, 1e-12);
        if (!uneven) {
          EXPECT_NEAR(parabola.share()[b], 2.0 / 3, 1e-12);
        }
      }
      const GlobalIndex walls = static_cast<GlobalIndex>(parabola.walls().size());
      EXPECT_EQ(global_sum(walls), 2 * 6 * std::max<Index>(nz, 1));
    }
}

TEST(WallParabola, LeavesCurvedWallsAndSimplicesAsTheyWere) {
  const auto largest = [](const test::BoxFile& box) {
    const Mesh mesh = test::read_box(box);
    const FaceWeights weights(mesh);
    const GradientStencil stencil = stencil_of(mesh, weights);
    const WallParabola parabola(mesh, channel(mesh), stencil);
    Real most = 0;
    for (Index b = 0; b < mesh.n_boundary(); ++b) most = std::max(most, parabola.share()[b]);
    return global_max(most);
  };
  const auto bent = [](Real turn) {  // of a normal from cell to cell
    return [turn](const Vec3& x) { return Vec3{x.x, x.y + turn * 6 * x.x * x.x / 2, x.z}; };
  };
  EXPECT_EQ(largest({.n = {6, 8, 0}, .moved = bent(0.1)}), 0);
  EXPECT_EQ(largest({.n = {6, 8, 4}, .moved = bent(0.1)}), 0);
  EXPECT_NEAR(largest({.n = {6, 8, 0}, .moved = bent(0.01)}), 1.0 / 3, 0.03);
  EXPECT_NEAR(largest({.n = {6, 8, 0}, .moved = bent(1e-12)}), 2.0 / 3, 1e-9);
  EXPECT_EQ(largest({.n = {6, 8, 0}, .simplex = true}), 0);
  EXPECT_EQ(largest({.n = {6, 1, 0}}), 0) << "one cell between two walls";
  EXPECT_GT(largest({.n = {6, 2, 0}}), 0.6);
}

TEST(WallParabola, KeepsOffASolid) {
  const Mesh mesh = test::read_box({.n = {6, 8, 0}});
  const FaceWeights weights(mesh);
  const GradientStencil stencil = stencil_of(mesh, weights);
  WallParabola parabola(mesh, channel(mesh), stencil);
  CellField<Real> alpha(mesh);
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Vec3& x = mesh.C[c];
    if (x.x > 0.5 && x.x < 0.6 && x.y > 0.125 && x.y < 0.25) alpha[c] = 0.25;
    if (c < mesh.n_owned) cells.push_back(c);
  }
  parabola.keep_off(alpha, cells);
  for (const Index b : parabola.walls()) {
    const Vec3& x = mesh.Cf[mesh.n_internal + b];
    const bool beside = x.y < 0.5 && std::abs(x.x - 7.0 / 12) < 0.2;
    EXPECT_NEAR(parabola.share()[b], (beside ? 0.75 : 1) * 2 / 3, 1e-12);
  }
  parabola.keep_off(alpha, cells);  // of a second solid
  for (const Index b : parabola.walls()) {
    const Vec3& x = mesh.Cf[mesh.n_internal + b];
    const bool beside = x.y < 0.5 && std::abs(x.x - 7.0 / 12) < 0.2;
    EXPECT_NEAR(parabola.share()[b], (beside ? 0.5 : 1) * 2 / 3, 1e-12);
  }
  parabola.reset();
  for (const Index b : parabola.walls()) EXPECT_NEAR(parabola.share()[b], 2.0 / 3, 1e-12);
}

}  // namespace
}  // namespace fsi::flow
