// The gradient of a pressure with given rises.

#include "libfsi/solid/level.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// Rises at some faces of irregular triangles, applied once and again: nothing is left of the last.
TEST(Level, IsMadeAnewEachTime) {
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
  solid::Level level(mesh, weights);
  const auto force_of = [&] {
    CellField<Vec3> force(mesh);
    FaceField<Real> balance(mesh);
    level.clear();
    for (Index f = 0; f < mesh.n_internal; ++f)
      if (std::abs(mesh.Cf[f].x - 0.5) < 0.1) level.add(f, mesh.Cf[f].y, stencil.cells);
    level.apply(force, balance, stencil, band);
    return force;
  };
  const CellField<Vec3> first = force_of(), again = force_of();
  bool same = true;
  for (Index c = 0; c < mesh.n_owned; ++c) same = same && first[c] == again[c];
  EXPECT_TRUE(all_of_ranks(same));
}

}  // namespace
}  // namespace fsi
