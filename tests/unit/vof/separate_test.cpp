// Cells that hold too much of two bodies.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/vof/separate.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

Real volume(const CellField<Real>& alpha, const Mesh& mesh) {
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) sum.add(mesh.V[c] * alpha[c]);
  return sum.total();
}

// Two bodies meet along x = 0.5 in a film of half a cell; in some cells of it they are a little too
// much. What is too much goes to the cells beside, and each keeps its volume.
TEST(Separate, MovesWhatIsTooMuchAndKeepsTheVolumes) {
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {9, 9, 0}, .simplex = simplex});
    CellField<Real> left(mesh), right(mesh), left_mid(mesh), right_mid(mesh);
    std::vector<Index> cells;
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Vec3& x = mesh.C[c];
      const bool film = std::abs(x.x - 0.5) < 0.06;
      left[c] = film ? 0.45 : x.x < 0.5 ? 1 : 0;
      right[c] = film ? 0.45 : x.x > 0.5 ? 1 : 0;
      if (film && std::abs(x.y - 0.5) < 0.06) left[c] += 0.13;
      if (film && c < mesh.n_owned) cells.push_back(c);
    }
    const Real of_left = volume(left, mesh), of_right = volume(right, mesh);
    CellField<Real> left_before(mesh);
    left_before.assign(left);
    vof::Separation separation(mesh, 2);
    const std::array bodies{vof::Fractions{&left, &left_mid}, vof::Fractions{&right, &right_mid}};
    EXPECT_TRUE(separation.apply(bodies, cells));
    EXPECT_NEAR(volume(left, mesh), of_left, 1e-14);
    EXPECT_NEAR(volume(right, mesh), of_right, 1e-14);
    EXPECT_LE(separation.overlap(), 1e-12);
    for (Index c = 0; c < mesh.n_owned; ++c) {
      EXPECT_LE(left[c] + right[c], 1 + 1e-12);
      EXPECT_GE(std::min(left[c], right[c]), 0);
    }
    EXPECT_FALSE(separation.apply(bodies, cells));
    for (Index c = 0; c < mesh.n_cells; ++c)  // the mean takes half of what is moved
      EXPECT_NEAR(left_mid[c], (left[c] - left_before[c]) / 2, 1e-15);
  }
}

// Four cells that hold too much of three bodies lie around one with little room: it is filled from
// all of them at once, and no more than full.
TEST(Separate, FillsNoCellFromAllItsFacesTooFar) {
  const Mesh mesh = test::read_box({.n = {9, 9, 0}});
  std::vector<CellField<Real>> alpha, mid;
  for (int i = 0; i < 3; ++i) alpha.emplace_back(mesh), mid.emplace_back(mesh);
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Real x = std::abs(mesh.C[c].x - 0.5) * 9, y = std::abs(mesh.C[c].y - 0.5) * 9;
    const bool in_middle = x + y<0.5, beside = x + y> 0.5 && x + y < 1.5;
    for (auto& one : alpha) one[c] = in_middle ? 0.3 : beside ? 0.5 : 0;
    if ((in_middle || beside) && c < mesh.n_owned) cells.push_back(c);
  }
  vof::Separation separation(mesh, 3);
  std::vector<vof::Fractions> bodies;
  for (int i = 0; i < 3; ++i) bodies.push_back({&alpha[i], &mid[i]});
  EXPECT_TRUE(separation.apply(bodies, cells));
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (std::abs(mesh.C[c].x - 0.5) + std::abs(mesh.C[c].y - 0.5) < 0.05) {
      const Real S = alpha[0][c] + alpha[1][c] + alpha[2][c];
      EXPECT_GT(S, 0.95);
      EXPECT_LE(S, 1 + 1e-12);
    }
}

}  // namespace
}  // namespace fsi
