// The gradient of a pressure: exact for linear fields, and a force of face values.

#include "libfsi/operators/gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/vertex_mean.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// Irregular triangles and tetrahedra.
Mesh irregular(Index depth) {
  test::BoxFile box{.n = {8, 6, depth}, .simplex = true};
  box.moved = [](const Vec3& x) {
    const Real inside = x.x * (1 - x.x) * x.y * (1 - x.y);
    return x + (0.5 * inside * std::sin(40 * x.x + 60 * x.y + 50 * x.z)) * Vec3{1, -1, 0};
  };
  return test::read_box(box);
}

TEST(PressureGradient, IsExactForLinearFields) {
  for (const Index depth : {0, 5})
    for (const bool given : {false, true}) {
      const Mesh mesh = irregular(depth);
      const FaceWeights weights(mesh);
      PressureStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), given));
      const Vec3 slope{1, -2, mesh.dim == 3 ? 3.0 : 0.0};
      CellField<Real> q(mesh);
      BoundaryField<Real> q_b(mesh);
      for (Index c = 0; c < mesh.n_cells; ++c) q[c] = dot(slope, mesh.C[c]);
      for (Index b = 0; b < mesh.n_boundary(); ++b)
        q_b[b] = given ? dot(slope, mesh.Cf[mesh.n_internal + b]) : 1e9;
      CellField<Vec3> grad(mesh), plain(mesh);
      std::vector<Vec3> grad_f(weights.irregular.size());
      gradient(plain, q, q_b, stencil.cells, mesh);
      stencil.at_faces.set(grad_f, plain);
      pressure_gradient(grad, grad_f, q, q_b, stencil.cells, mesh);
      Real worst = 0;
      // a cell at the boundary may have too few neighbours where that has no value
      for (Index c = 0; c < mesh.n_owned; ++c)
        if (given || std::max(std::abs(mesh.C[c].x - 0.5), std::abs(mesh.C[c].y - 0.5)) < 0.25)
          worst = std::max(worst, norm(grad[c] - slope));
      EXPECT_LE(global_max(worst), 1e-11) << mesh.dim << " " << given;
    }
}

// On a plane of symmetry the boundary has the cell's own velocity along it, which is that at the
// foot of the cell's centre: the face's centre may lie a third of a cell aside.
TEST(Gradient, IsExactForALinearVelocityAtAPlaneOfSymmetry) {
  for (const Index depth : {0, 5}) {
    const Mesh mesh = irregular(depth);
    const FaceWeights weights(mesh);
    std::vector<bool> plane;
    for (const Patch& patch : mesh.patches) plane.push_back(patch.name == "bottom");
    const GradientStencil stencil(mesh, weights, std::vector<bool>(plane.size(), true), plane);
    const Tensor L{1, 0, mesh.dim == 3 ? 4.0 : 0.0, 0, -2, 0, 3, 0, mesh.dim == 3 ? 1.0 : 0.0};
    CellField<Vec3> u(mesh);
    BoundaryField<Vec3> u_b(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) u[c] = dot(L, mesh.C[c]);
    for (std::size_t i = 0; i < plane.size(); ++i)
      for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
        const Vec3 own = u[mesh.owner[f]], S = mesh.Sf[f];
        u_b[f - mesh.n_internal] = plane[i] ? own - (dot(own, S) / norm2(S)) * S
                                            : dot(L, mesh.C[mesh.owner[f]] + mesh.d[f]);
      }
    CellField<Tensor> of_u(mesh);
    gradient(of_u, u, u_b, stencil, mesh);
    Real worst = 0;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const Tensor off = of_u[c] + -1.0 * L;
      worst = std::max(worst, std::sqrt(trace(dot(off, transpose(off)))));
    }
    EXPECT_LE(global_max(worst), 1e-11) << mesh.dim;
  }
}

// Whatever the pressure, what one cell loses another gets: its forces add up to that of the walls.
TEST(PressureGradient, HasNoMeanForceOfItsOwn) {
  for (const Index depth : {0, 5}) {
    const Mesh mesh = irregular(depth);
    const FaceWeights weights(mesh);
    PressureStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), true));
    CellField<Real> q(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) q[c] = std::sin(1e3 * mesh.C[c].x + 1e4 * mesh.C[c].y);
    CellField<Vec3> grad(mesh);
    const BoundaryField<Real> zero(mesh);
    std::vector<Vec3> grad_f(weights.irregular.size());
    gradient(grad, q, zero, stencil.cells, mesh);
    stencil.at_faces.set(grad_f, grad);
    const auto sum_of = [&] {
      Sum x, y;
      for (Index c = 0; c < mesh.n_owned; ++c)
        x.add(mesh.V[c] * grad[c].x), y.add(mesh.V[c] * grad[c].y);
      return std::hypot(x.total(), y.total());
    };
    pressure_gradient(grad, grad_f, q, zero, stencil.cells, mesh);
    EXPECT_LE(sum_of(), 1e-13);
    gradient(grad, q, zero, stencil.cells, mesh);
    EXPECT_GE(sum_of(), 1e-3);  // the plain one has
  }
}

}  // namespace
}  // namespace fsi
