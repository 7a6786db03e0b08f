// What limits a step on cells of all sizes, and what of their convection is implicit.

#include "libfsi/flow/courant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::flow {
namespace {

/// A uniform flow, and the largest Courant number of single cells per time.
struct Uniform {
  explicit Uniform(const Mesh& mesh) : phi(mesh) {
    for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = dot(Vec3{1, 0.3, 0.2}, mesh.Sf[f]);
    for (Index c = 0; c < mesh.n_owned; ++c)
      largest = std::max(largest, courant_rate(phi, mesh, c));
    largest = global_max(largest);
  }
  FaceField<Real> phi;
  Real largest = 0;
};

/// Layers of thickness 1 / 6, one of them much thinner: where its points are.
Vec3 thin_layer(const Vec3& x) {
  const bool moved = x.z > 0.4 && x.z < 0.6;
  return moved ? Vec3{x.x, x.y, 1.0 / 3 + 0.005} : x;
}

TEST(Courant, IsThatOfACellOnHexahedra) {
  const Mesh mesh = test::read_box({.n = {4, 4, 6}, .moved = thin_layer});
  const Uniform flow(mesh);
  Courant courant(mesh);
  EXPECT_FALSE(courant.any_simplex());
  EXPECT_NEAR(courant.rate(flow.phi), flow.largest, 1e-12 * flow.largest);
  FaceField<Real> kappa(mesh);
  courant.add_implicit(kappa, flow.phi, 1, 100 / flow.largest, FaceWeights(mesh));
  for (Index f = 0; f < mesh.n_faces; ++f) EXPECT_EQ(kappa[f], 0);
}

TEST(Courant, IsThatOfTheNeighbourhoodOnTetrahedra) {
  const Mesh mesh = test::read_box({.n = {4, 4, 6}, .simplex = true, .moved = thin_layer});
  const Uniform flow(mesh);
  Courant courant(mesh);
  EXPECT_LT(courant.rate(flow.phi), 0.3 * flow.largest) << "a thin layer holds it less";
}

// With the term the explicit part of each cell's Courant number is C, whatever the step.
TEST(Courant, WhatIsBeyondTheBoundIsImplicit) {
  const Mesh mesh = test::read_box({.n = {4, 4, 6}, .simplex = true, .moved = thin_layer});
  const Uniform flow(mesh);
  const FaceWeights weights(mesh);
  constexpr Real rho = 3;
  for (const auto scheme : {Convection::linear, Convection::linear_upwind}) {
    Courant courant(mesh, scheme);
    for (const Real most : {0.5, 1.0, 5.0, 50.0}) {
      const Real dt = most * courant.explicit_part() / flow.largest;
      FaceField<Real> kappa(mesh);
      courant.add_implicit(kappa, flow.phi, rho, dt, weights);
      Real any = 0;
      for (Index c = 0; c < mesh.n_owned; ++c) {
        Real sum = 0, inner = 0, all = 0;
        for (const Index f : mesh.cell_faces[c]) {
          sum += kappa[f] * weights.g[f] * dt / (rho * mesh.V[c]);
          all += std::abs(flow.phi[f]);
          if (f < mesh.n_internal) inner += std::abs(flow.phi[f]);
        }
        any = std::max(any, sum);
        const Real own = dt * courant_rate(flow.phi, mesh, c);
        if (inner == all) {
          EXPECT_LE(own / (1 + sum), (1 + 1e-12) * courant.explicit_part()) << most;
        }
      }
      EXPECT_EQ(global_max(any) > 0, most > 1) << "nothing is implicit below the bound";
    }
  }
}

}  // namespace
}  // namespace fsi::flow
