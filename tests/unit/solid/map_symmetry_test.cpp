// A reference map at a plane of symmetry goes on as in the whole solid.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/reference_map.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

TEST(Image, IsItsOwnInverseAndThatOfAProduct) {
  const Vec3 n = Vec3{1, 2, -2} / 3, v{0.3, -0.7, 1.1};
  const Tensor g{0.6, 0.3, 0.1, -0.2, 0.9, 0.2, 0.1, -0.3, 0.7};
  EXPECT_NEAR(norm(image(image(v, n), n) - v), 0, 1e-15);
  EXPECT_NEAR(dot(image(v, n) + v, n), 0, 1e-15);
  EXPECT_NEAR(norm(dot(image(g, n), image(v, n)) - image(dot(g, v), n)), 0, 1e-15);
}

SymmetryFaces faces_of(const Mesh& mesh, const char* patch) {
  std::vector<char> faces(static_cast<std::size_t>(mesh.n_boundary()), 0);
  const Patch& of = mesh.patch(patch);
  for (Index f = of.begin; f < of.end; ++f) faces[f - mesh.n_internal] = 1;
  return {faces, mesh};
}

/// Sums over the part z > 1/2 of a box that is full of solid within 0.3 of its middle: of |d|^2 and
/// the entries of B after steps of a rough map in the flow (z - 1/2)^2 e_x + curl.
std::array<Real, 3> after_steps(const test::BoxFile& box, Real plane, const char* mirror) {
  const Mesh mesh = test::read_box(box);
  const FaceWeights weights(mesh);
  const GradientStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false));
  CellField<Real> alpha(mesh);
  FaceField<Real> phi(mesh);
  CellField<Vec3> u(mesh);
  CellField<Tensor> L(mesh);
  CellField<solid::SymGradient> grad(mesh);
  const auto flow = [plane](const Vec3& x) {
    const Real z = x.z - plane;
    return Vec3{0.3 + z * z - 0.4 * x.y, 0.4 * x.x, 0};
  };
  const SymmetryFaces symmetry = *mirror != 0 ? faces_of(mesh, mirror) : SymmetryFaces{};
  solid::ReferenceMap map(mesh, solid::ReferenceMap::Role::alone, {}, symmetry);
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Vec3 r = mesh.C[c] - Vec3{0.5, 0.5, plane};
    alpha[c] = norm(r) < 0.3 ? 1 : 0;
    const Real rough = std::sin(97 * r.x + 61 * r.y + 83 * r.z * r.z);
    u[c] = flow(mesh.C[c]);
    L[c] = {0, -0.4, 2 * r.z, 0.4, 0, 0, 0, 0, 0};
    map.set_map(c, mesh.C[c] + 2e-3 * Vec3{rough, rough * rough, rough * (r.z > 0 ? 1 : -1)});
  }
  for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = dot(flow(mesh.Cf[f]), mesh.Sf[f]);
  map.resume(alpha, grad);
  for (int i = 0; i < 10; ++i) {
    map.mark(alpha);
    map.transport(alpha, {phi, u, L, stencil, weights}, 0.01, grad);
  }
  std::array<Sum, 3> sums;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (mesh.C[c].z < plane) continue;
    const SymTensor B = map.B(c, alpha[c]);
    sums[0].add(norm2(map.d[c])), sums[1].add(B.xz * B.xz), sums[2].add(B.zz);
  }
  std::array<Real, 3> total{};
  Sum::totals(total, sums);
  return total;
}

// A solid that reaches a plane of symmetry later has no images there. A pressure has, and the
// gradient of T must not take them over: it was half as large along the normal.
TEST(Gradient, OfALinearStressIsExactAtAPlaneWithoutImages) {
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {6, 6, 6}, .simplex = simplex});
    const FaceWeights weights(mesh);
    std::vector<bool> mirrors;
    for (const Patch& patch : mesh.patches) mirrors.push_back(patch.name == "back");
    const GradientStencil of_p(mesh, weights, std::vector<bool>(mesh.patches.size(), false),
                               mirrors);
    CellField<SymTensor> T(mesh);
    CellField<solid::SymGradient> grad(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) T[c] = {0, mesh.C[c].z, 2 * mesh.C[c].z, 0, 0, 0};
    std::vector<Index> cells;
    for (Index c = 0; c < mesh.n_owned; ++c)
      if (std::hypot(mesh.C[c].x - 0.5, mesh.C[c].y - 0.5) < 0.3 && mesh.C[c].z < 0.5)
        cells.push_back(c);
    solid::gradient(grad, T, of_p, {}, mesh, cells);
    for (const Index c : cells) {
      EXPECT_NEAR(grad[c].z.xy, 1, 1e-12);
      EXPECT_NEAR(grad[c].z.xz, 2, 1e-12);
    }
  }
}

// Taken in by the cells of one side alone, a gradient at the plane lets a stiff ball tremble.
TEST(ReferenceMap, AtAPlaneOfSymmetryIsThatOfTheWholeSolid) {
  const auto whole = after_steps({.n = {12, 12, 12}}, 0.5, "");
  const auto upper = after_steps({.n = {12, 12, 6}, .length = {1, 1, 0.5}}, 0, "back");
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(upper[i] / whole[i], 1, 1e-11);
}

// A solid that turned about the normal of the plane is not strained there, whatever its cells: the
// foot of a centre on the plane is not the centre of the face.
TEST(ReferenceMap, ATurnAtAPlaneOfSymmetryIsNoStrain) {
  const auto leaning = [](const Vec3& x) {
    return Vec3{x.x + 0.4 * x.z, x.y + 0.1 * std::sin(4 * x.x) * x.z, x.z};
  };
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box(
        {.n = {8, 8, 4}, .length = {1, 1, 0.5}, .simplex = simplex, .moved = leaning});
    const SymmetryFaces symmetry = faces_of(mesh, "back");
    solid::ReferenceMap map(mesh, solid::ReferenceMap::Role::alone, {}, symmetry);
    CellField<Real> alpha(mesh);
    CellField<solid::SymGradient> grad(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Vec3 x = mesh.C[c];
      alpha[c] = norm(x - Vec3{0.6, 0.5, 0}) < 0.35 ? 1 : 0;
      map.set_map(c, {-x.y, x.x, x.z});
    }
    map.resume(alpha, grad);
    Real worst = 0;
    for (const Index c : map.cells()) {
      const SymTensor e = map.B(c, alpha[c]) - identity();
      for (const Real v : {e.xx, e.xy, e.xz, e.yy, e.yz, e.zz})
        worst = std::max(worst, std::abs(v));
    }
    EXPECT_LE(global_max(worst), 1e-11);
  }
}

}  // namespace
}  // namespace fsi
