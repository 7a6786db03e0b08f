// A solid's tensor carried outward, and what alternates in it damped.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "libfsi/solid/extension.hpp"
#include "tests/unit/solid/full.hpp"

namespace fsi {
namespace {

using std::numbers::pi;
using test::largest;

/// A tensor T known in a ball, `radius` wide.
struct Known {
  Known(const test::BoxFile& box, Real radius, const std::function<SymTensor(const Vec3&)>& T_0)
      : mesh(test::read_box(box)),
        alpha(mesh),
        T(mesh),
        slope(mesh),
        all(mesh, 1),
        known(mesh),
        extension(mesh) {
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Vec3 x = mesh.C[c] - Vec3{0.5, 0.5, mesh.dim == 3 ? 0.5 : 0};
      alpha[c] = norm(x) < radius ? 1 : 0;
      T[c] = alpha[c] * T_0(mesh.C[c]);
    }
    known.rebuild(alpha, solid::alpha_known);
    extension.mark(alpha, known);
  }
  Mesh mesh;
  CellField<Real> alpha;
  CellField<SymTensor> T;
  CellField<solid::SymGradient> slope;
  CellField<Real> all;
  Band known;
  solid::Extension extension;
};

/// Plus and minus one by turns on 16 x 16 quads.
SymTensor checks(const Vec3& x) {
  return SymTensor{std::cos(16 * pi * (x.x - 0.03125)) * std::cos(16 * pi * (x.y - 0.03125))};
}

const std::vector<test::BoxFile> boxes{{.n = {20, 20, 0}},
                                       {.n = {20, 20, 0}, .simplex = true},
                                       {.n = {14, 14, 14}},
                                       {.n = {8, 8, 8}, .simplex = true}};

SymTensor linear(const Vec3& x) { return {1 + x.x, 2 * x.y - x.x, x.z, -3 * x.y, 0.5, x.x - x.z}; }

// Three rings of cells around a ball go on as the ball does.
TEST(Extension, IsExactForALinearTensor) {
  for (const test::BoxFile& box : boxes) {
    Known run(box, 0.28, linear);
    run.extension.linear(run.T, run.slope);
    int set = 0;
    for (Index c = 0; c < run.mesh.n_cells; ++c) {
      if (run.extension.near()[c] == 0) continue;
      EXPECT_LE(largest(run.T[c] - linear(run.mesh.C[c])), 1e-12);
      EXPECT_TRUE(c >= run.mesh.n_owned || run.slope[c].x == SymTensor{});
      ++set;
    }
    EXPECT_GT(set, 0);
  }
}

// Between planes of symmetry two layers of cells are no thin solid: nothing varies across them.
TEST(Extension, IsExactInTwoLayersBetweenPlanesOfSymmetry) {
  const auto in_plane = [](const Vec3& x) {
    return SymTensor{1 + x.x, 2 * x.y - x.x, 0, -3 * x.y, 0, 0.5 + x.y};
  };
  Known run({.n = {20, 20, 2}, .length = {1, 1, 0.1}}, 0.7, in_plane);
  const Mesh& mesh = run.mesh;
  std::vector<char> faces(static_cast<std::size_t>(mesh.n_boundary()), 0);
  for (const Patch& patch : mesh.patches)
    for (Index f = patch.begin; f < patch.end; ++f)
      faces[f - mesh.n_internal] = std::abs(mesh.Sf[f].z) > 0 ? 1 : 0;
  solid::Extension extension(mesh, {faces, mesh});
  for (Index c = 0; c < mesh.n_cells; ++c) {
    run.alpha[c] = std::hypot(mesh.C[c].x - 0.5, mesh.C[c].y - 0.5) < 0.28 ? 1 : 0;
    run.T[c] = run.alpha[c] * in_plane(mesh.C[c]);
  }
  run.known.rebuild(run.alpha, solid::alpha_known);
  extension.mark(run.alpha, run.known);
  extension.linear(run.T, run.slope);
  for (Index c = 0; c < mesh.n_cells; ++c)
    if (extension.near()[c] != 0) {
      EXPECT_LE(largest(run.T[c] - in_plane(mesh.C[c])), 1e-12);
    }
}

// What alternates from cell to cell goes no further out than it is high; a solid two cells thick
// goes on as a constant.
TEST(Extension, DoesNotExtrapolateNoise) {
  Known noise({.n = {16, 16, 0}}, 0.3, checks);
  Known thin({.n = {16, 16, 0}}, 0.09, [](const Vec3& x) { return SymTensor{x.x}; });
  for (Known* run : {&noise, &thin}) run->extension.linear(run->T, run->slope);
  for (Index c = 0; c < noise.mesh.n_owned; ++c) {
    EXPECT_LE(std::abs(noise.T[c].xx), 1 + 1e-12);
    EXPECT_LE(std::abs(thin.T[c].xx), 0.5 + 0.03125 + 1e-12);
  }
}

// Nothing is taken from a linear tensor, however far the wave goes.
TEST(Extension, DampsNoLinearTensor) {
  for (const test::BoxFile& box : boxes) {
    Known run(box, 0.28, linear);
    run.extension.fourth_difference_filter(run.T, run.slope, run.all, 10, 1e3, 1);
    for (Index c = 0; c < run.mesh.n_owned; ++c) {
      EXPECT_LE(largest(run.T[c] - run.alpha[c] * linear(run.mesh.C[c])), 1e-12);
      EXPECT_TRUE(run.slope[c].x == SymTensor{});
    }
  }
}

// Of eight neighbours the four across the faces have the other sign and two thirds of the weight:
// what alternates loses 4/3 of the share, by the wave's pace or that of the recovery if slower.
TEST(Extension, DampsWhatAlternates) {
  for (const Real recovery : {1e3, 2.0}) {
    Known run({.n = {16, 16, 0}}, 0.4, checks);
    run.extension.fourth_difference_filter(run.T, run.slope, run.all, 0.6, recovery, 0.5);
    const Real left = 1 - 4.0 / 3 * (1 - std::exp(-0.1 * std::min(0.6 * 16, recovery) * 0.5));
    int inside = 0;
    for (Index c = 0; c < run.mesh.n_owned; ++c) {
      if (norm(run.mesh.C[c] - Vec3{0.5, 0.5, 0}) > 0.25) continue;
      EXPECT_NEAR(run.T[c].xx, left * checks(run.mesh.C[c]).xx, 1e-12);
      ++inside;
    }
    EXPECT_GT(global_sum(inside), 0);
  }
}

// Fourth differences: a sixteenth of a smooth tensor's change with cells half as large, the share
// held.
TEST(Extension, DampsASmoothTensorByFourthDifferences) {
  const auto wave = [](const Vec3& x) { return SymTensor{std::sin(pi * x.x) * std::cos(x.y)}; };
  const auto change = [&](Index n) {
    Known run({.n = {n, n, 0}}, 0.4, wave);
    run.extension.fourth_difference_filter(run.T, run.slope, run.all, 1.0 / static_cast<Real>(n),
                                           1e3, 1);
    Real most = 0;
    for (Index c = 0; c < run.mesh.n_owned; ++c)
      if (norm(run.mesh.C[c] - Vec3{0.5, 0.5, 0}) < 0.2)
        most = std::max(most, largest(run.T[c] - wave(run.mesh.C[c])));
    return global_max(most);
  };
  EXPECT_NEAR(std::log2(change(16) / change(32)), 4, 0.2);
}

}  // namespace
}  // namespace fsi
