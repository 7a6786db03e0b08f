// The jump of the pressure goes on with the surface by what the cells gain.

#include "libfsi/solid/pressure_jump.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/support/box_file.hpp"

namespace fsi::solid {
namespace {

// A surface normal to x in the third of six columns, which gains 2 (0.5 - 0.4) of solid;
// G dev(T) along x is 0.5 (3 - 1).
TEST(PressureJump, GoesOnWithTheSurface) {
  const Mesh mesh = test::read_box({.n = {6, 6, 0}});
  CellField<Real> p(mesh, 7), alpha(mesh), alpha_mid(mesh), change(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const bool cut = std::abs(mesh.C[c].x - 2.5 / 6) < 0.01;
    alpha[c] = cut ? 0.5 : mesh.C[c].x < 0.5 ? 1 : 0;
    alpha_mid[c] = cut ? 0.4 : alpha[c];
    change[c] = cut ? 0.5 * 2 * 0.2 : 0;
  }
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_owned; ++c) cells.push_back(c);
  const CellField<SymTensor> T(mesh, {.xx = 3});
  advect_pressure_jump(p, alpha_mid, alpha, T, 0.5, mesh, cells);
  Real worst = 0;
  for (const Index c : cells) worst = std::max(worst, std::abs(p[c] - 7 - change[c]));
  EXPECT_LT(global_max(worst), 1e-14);
}

}  // namespace
}  // namespace fsi::solid
