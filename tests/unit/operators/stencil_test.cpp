// What lies around a cell and on both sides of a face.

#include "libfsi/operators/stencil.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/support/box_mesh.hpp"

namespace fsi {
namespace {

Mesh periodic(Index depth) {
  return test::box_mesh({.n = {4, 5, depth}, .length = {2, 1, 1}, .periodic = {true, true, true}});
}

// Of a box that is periodic all round every cell is in the middle: all arms reach one cell.
TEST(Stencil, ArmsDoNotSeeThePeriod) {
  for (const Index depth : {0, 3}) {
    const Mesh mesh = periodic(depth);
    const Vec3 h{2.0 / 4, 1.0 / 5, depth > 0 ? 1.0 / 3 : 1};
    for (Index c = 0; c < mesh.n_owned; ++c) {
      Vec3 sum;
      int n = 0, images = 0;
      for_vertex_neighbours(c, mesh, [&](Index k, const Vec3& r) {
        EXPECT_NE(k, c);
        for (int i = 0; i < mesh.dim; ++i)
          EXPECT_NEAR(std::abs(r[i] / h[i]) * (std::abs(r[i] / h[i]) - 1), 0, 1e-12);
        sum += r, ++n;
      });
      for_vertex_images(c, mesh, [&](Index k, const Vec3& t) {
        EXPECT_LE(norm(mesh.C[k] + t - mesh.C[c]), norm(h) + 1e-12);
        ++images;
      });
      EXPECT_EQ(n, mesh.dim == 2 ? 8 : 26);
      EXPECT_EQ(n, images);
      EXPECT_LE(norm(sum), 1e-12);
    }
  }
}

TEST(Stencil, BeyondAFaceIsTheOtherCellOrTheBoundary) {
  const Mesh mesh = test::box_mesh({.n = {3, 2, 0}});
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const Index P = mesh.owner[f];
    EXPECT_EQ(beyond(mesh, f, P), f < mesh.n_internal ? mesh.neighbour[f] : -1);
    EXPECT_EQ(outward(mesh, f, P), 1);
    if (f >= mesh.n_internal) continue;
    EXPECT_EQ(beyond(mesh, f, mesh.neighbour[f]), P);
    EXPECT_EQ(outward(mesh, f, mesh.neighbour[f]), -1);
  }
}

// Between cells of unlike width the one mean is exact for a linear field, the other its mirror.
TEST(Stencil, MeansAtAFace) {
  const Mesh mesh = periodic(3);
  FaceWeights weights(mesh);
  CellField<Real> q(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) q[c] = 1 + c;
  for (Index f = 0; f < mesh.n_internal; ++f) {
    weights.lambda[f] = 0.25;
    const Real P = q[mesh.owner[f]], N = q[mesh.neighbour[f]];
    EXPECT_EQ(face_mean(q, f, weights, mesh), 0.75 * P + 0.25 * N);
    EXPECT_EQ(mirror_mean(q, f, weights, mesh), 0.25 * P + 0.75 * N);
  }
}

TEST(Stencil, SizeOfACell) {
  EXPECT_NEAR(cell_size(test::box_mesh({.n = {4, 4, 0}}), 0), 0.25, 1e-15);
  EXPECT_NEAR(cell_size(test::box_mesh({.n = {4, 2, 1}}), 0), 0.5, 1e-15);
}

TEST(Stencil, SquareAndAdjugate) {
  const Vec3 a{1, -2, 3}, b{0.5, 4, -1}, v{2, 7, -3};
  EXPECT_EQ(dot(square(a), v), dot(a, v) * a);
  EXPECT_EQ(dot(both_ways(a, b), v), dot(b, v) * a + dot(a, v) * b);
  const SymTensor t{4, 1, -1, 3, 0.5, 2};
  EXPECT_LE(norm(dot(inverse(t), dot(t, v)) - v), 1e-14);
  EXPECT_LE(norm(dot(adjugate(t), dot(t, v)) - det(t) * v), 1e-13);
  const Tensor A{1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_LE(norm(dot(dot(A, t), v) - dot(A, dot(t, v))), 1e-13);
}

}  // namespace
}  // namespace fsi
