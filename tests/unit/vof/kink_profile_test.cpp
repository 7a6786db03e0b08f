// What a kink at the surface adds to the value of a cut cell.

#include "libfsi/vof/kink_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::vof {
namespace {

/// The plane n . (x - at) = 0 in the cells it cuts.
struct Cuts {
  Cuts(const test::BoxFile& box, const Vec3& normal, const Vec3& point)
      : mesh(test::read_box(box)), weights(mesh), interface(mesh), kink_profile(mesh), at(point) {
    n = normal / norm(normal);
    geometry::Polytope cell(mesh.dim);
    for (Index c = 0; c < mesh.n_owned; ++c) {
      gather(cell, mesh, c);
      const geometry::Cut cut = geometry::cut(cell, {n, dot(n, at - mesh.C[c])});
      if (!(cut.area > 0)) continue;
      interface.piece[c] = {n, mesh.C[c] + cut.centre, cut.area};
      interface.cells.push_back(c);
    }
    kink_profile.set(interface, weights);
  }
  Real s(Index c) const { return dot(n, mesh.C[c] - at); }
  bool beside_boundary(Index c) const {
    return std::ranges::any_of(mesh.cell_faces[c], [&](Index f) { return f >= mesh.n_internal; });
  }

  Mesh mesh;
  FaceWeights weights;
  Interface interface;
  KinkProfile kink_profile;
  Vec3 n, at;
};

// Along a row of triangles, or of quads, prisms and lines are cut alike.
TEST(KinkProfile, IsTheDistanceWhereThePlaneLiesAlongFaces) {
  for (const bool simplex : {false, true}) {
    const Cuts cuts({.n = {6, 6, 0}, .simplex = simplex}, {0, 1, 0}, {0, 3.5 / 6, 0});
    for (const Index c : cuts.interface.cells) {
      if (cuts.beside_boundary(c)) continue;
      EXPECT_NEAR(cuts.kink_profile.solid_side[c], std::max(Real{0}, cuts.s(c)), 1e-14);
      EXPECT_NEAR(cuts.kink_profile.fluid_side[c], std::max(Real{0}, -cuts.s(c)), 1e-14);
    }
  }
}

// Across a mesh prisms and lines differ, by some hundredths of a cell.
TEST(KinkProfile, DiffersFromTheDistanceElsewhere) {
  for (const Index depth : {0, 4}) {
    const Vec3 normal = depth == 0 ? Vec3{3, 1.3, 0} : Vec3{3, 1.3, 2.2};
    const Cuts cuts({.n = {8, 8, depth}, .simplex = true}, normal, {0.45, 0.5, 0.5});
    const Real h = 1.0 / (depth == 0 ? 8 : 4);
    Real most = 0;
    for (const Index c : cuts.interface.cells) {
      if (cuts.beside_boundary(c)) continue;
      EXPECT_EQ(norm(cuts.kink_profile.normal[c] - cuts.n), 0);
      EXPECT_NEAR(cuts.kink_profile.solid_side[c] - cuts.kink_profile.fluid_side[c], cuts.s(c),
                  1e-14);
      const Real more = cuts.kink_profile.solid_side[c] - std::max(Real{0}, cuts.s(c));
      most = std::max(most, std::abs(more));
    }
    EXPECT_GE(global_max(most), 0.01 * h);
    EXPECT_LE(global_max(most), 0.1 * h);
  }
}

TEST(KinkProfile, IsZeroAgainWhereNoPlaneIsLeft) {
  Cuts cuts({.n = {4, 4, 0}, .simplex = true}, {1, 2, 0}, {0.5, 0.5, 0});
  cuts.interface.cells.clear();
  cuts.kink_profile.set(cuts.interface, cuts.weights);
  for (Index c = 0; c < cuts.mesh.n_cells; ++c) {
    EXPECT_EQ(norm(cuts.kink_profile.normal[c]), 0);
    EXPECT_EQ(cuts.kink_profile.solid_side[c], 0);
    EXPECT_EQ(cuts.kink_profile.fluid_side[c], 0);
  }
}

}  // namespace
}  // namespace fsi::vof
