// The gradient of a pressure with given rises.

#include "libfsi/solid/balanced_jump_force.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// Rises at some faces of irregular triangles, applied once and again: nothing is left of the last.
TEST(BalancedJumpForce, IsMadeAnewEachTime) {
  test::BoxFile box{.n = {8, 6, 0}, .simplex = true};
  box.moved = [](const Vec3& x) {
    const Real inside = x.x * (1 - x.x) * x.y * (1 - x.y);
    return x + (0.5 * inside * std::sin(40 * x.x + 60 * x.y)) * Vec3{1, -1, 0};
  };
  const Mesh mesh = test::read_box(box);
  const FaceWeights weights(mesh);
  PressureStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false));
  Band band(mesh);
  band.rebuild(CellField<Real>(mesh, 1), 0.5);
  solid::BalancedJumpForce level(mesh, weights);
  const auto force_of = [&] {
    CellField<Vec3> force(mesh);
    FaceField<Real> rhie_chow_source(mesh);
    level.clear();
    for (Index f = 0; f < mesh.n_internal; ++f)
      if (std::abs(mesh.Cf[f].x - 0.5) < 0.1) level.add(f, mesh.Cf[f].y, stencil.cells);
    level.apply(force, rhie_chow_source, stencil, band);
    return force;
  };
  const CellField<Vec3> first = force_of(), again = force_of();
  bool same = true;
  for (Index c = 0; c < mesh.n_owned; ++c) same = same && first[c] == again[c];
  EXPECT_TRUE(all_of_ranks(same));
}

/// The force of rises around the last point of a way along x, by a level that has gone it all.
CellField<Vec3> after_a_way(const Mesh& mesh, const std::vector<Real>& way) {
  const FaceWeights weights(mesh);
  PressureStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false));
  Band band(mesh);
  solid::BalancedJumpForce level(mesh, weights);
  CellField<Vec3> force(mesh);
  for (const Real at : way) {
    CellField<Real> here(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) here[c] = std::abs(mesh.C[c].x - at) < 0.1 ? 1 : 0;
    band.rebuild(here, 0.5);
    FaceField<Real> rhie_chow_source(mesh);
    force.fill({});
    level.clear();
    for (const Index f : band.faces())
      if (f < mesh.n_internal) level.add(f, 1 + mesh.Cf[f].y, stencil.cells);
    level.apply(force, rhie_chow_source, stencil, band);
  }
  return force;
}

// A band that moves on, along walls, leaves nothing behind: bent hexes and tets.
TEST(BalancedJumpForce, ForgetsWhereItsBandWas) {
  for (const bool simplex : {false, true}) {
    test::BoxFile box{.n = {20, 4, 4}, .length = {2, 1, 1}, .simplex = simplex};
    box.moved = [](const Vec3& x) {  // every wall bends as well
      return x + 0.03 * Vec3{std::sin(5 * x.y + 3 * x.z), std::sin(4 * x.x), std::cos(5 * x.x)};
    };
    const Mesh mesh = test::read_box(box);
    const CellField<Vec3> fresh = after_a_way(mesh, {1.4}),
                          moved = after_a_way(mesh, {1.4, 1.2, 1, 0.8, 1, 1.2, 1.3, 1.6, 1.4});
    bool same = true;
    for (Index c = 0; c < mesh.n_owned; ++c) same = same && fresh[c] == moved[c];
    EXPECT_TRUE(all_of_ranks(same));
  }
}

}  // namespace
}  // namespace fsi
