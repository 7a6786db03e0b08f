// What limits a step on cells of all sizes, and what of their convection is implicit.

#include "libfsi/flow/courant.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

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

/// V + K, or the convection of a step, of one component, without what the boundary faces carry.
struct Operators {
  Operators(const Mesh& mesh_now, const FaceField<Real>& kappa, const FaceField<Real>& phi,
            Real rho, Real dt, const FaceWeights& weights)
      : mesh(mesh_now), diagonal(mesh.V.begin(), mesh.V.begin() + mesh.n_owned) {
    for (Index f = 0; f < mesh.n_internal; ++f) {
      const Index P = mesh.owner[f];
      k.push_back(kappa[f] * weights.g[f] * dt / rho), carried.push_back(dt * phi[f] / 2);
      diagonal[P] += k.back(), diagonal[mesh.neighbour[f]] += k.back();
    }
  }
  using Vector = std::vector<Real>;
  Vector held(const Vector& v) const {
    Vector sum(v.size());
    for (std::size_t c = 0; c < v.size(); ++c) sum[c] = diagonal[c] * v[c];
    for (Index f = 0; f < mesh.n_internal; ++f) {
      const Index P = mesh.owner[f], N = mesh.neighbour[f];
      sum[P] -= k[f] * v[N], sum[N] -= k[f] * v[P];
    }
    return sum;
  }
  Vector convected(const Vector& v) const {
    Vector sum(v.size());
    for (Index f = 0; f < mesh.n_internal; ++f) {
      const Index P = mesh.owner[f], N = mesh.neighbour[f];
      sum[P] += carried[f] * v[N], sum[N] -= carried[f] * v[P];
    }
    return sum;
  }
  /// (V + K)^-1 b by conjugate gradients.
  Vector solved(const Vector& b) const {
    Vector x(b.size()), r = b, z(b.size()), p(b.size());
    Real last = 0;
    for (int i = 0; i < 400; ++i) {
      for (std::size_t c = 0; c < b.size(); ++c) z[c] = r[c] / diagonal[c];
      const Real rz = inner(r, z);
      if (rz < 1e-28 * inner(b, b)) break;
      for (std::size_t c = 0; c < b.size(); ++c) p[c] = z[c] + (i == 0 ? 0 : rz / last) * p[c];
      const Vector Ap = held(p);
      const Real step = rz / inner(p, Ap);
      for (std::size_t c = 0; c < b.size(); ++c) x[c] += step * p[c], r[c] -= step * Ap[c];
      last = rz;
    }
    return x;
  }
  static Real inner(const Vector& a, const Vector& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), Real{0});
  }
  /// Largest |(V + K)^-1 A v| / |v| in the norm of V + K, by the power method: a lower bound.
  Real largest() const {
    Vector v(diagonal.size());
    for (std::size_t c = 0; c < v.size(); ++c) v[c] = std::sin(static_cast<Real>(7 * c * c + 1));
    Real ratio = 0;
    for (int i = 0; i < 60; ++i) {
      const Real before = inner(v, held(v));
      for (Real& value : v) value /= std::sqrt(before);
      v = solved(convected(v));
      ratio = std::sqrt(inner(v, held(v)));
    }
    return ratio;
  }
  const Mesh& mesh;
  Vector diagonal, k, carried;
};

// With the term the convection of a step is C at most for every wave, whatever the step.
TEST(Courant, WhatIsBeyondTheBoundIsImplicit) {
  if (ranks() > 1) GTEST_SKIP() << "the test's own solver knows one rank";
  const Mesh mesh = test::read_box({.n = {4, 4, 6}, .simplex = true, .moved = thin_layer});
  const Uniform flow(mesh);
  const FaceWeights weights(mesh);
  constexpr Real rho = 3;
  for (const auto scheme : {Convection::linear, Convection::linear_upwind}) {
    Courant courant(mesh, scheme);
    const Real C = courant.explicit_part();
    for (const Real most : {0.5, 1.0, 1.5, 5.0, 50.0}) {
      const Real dt = most * C / flow.largest;
      FaceField<Real> kappa(mesh);
      courant.add_implicit(kappa, flow.phi, rho, dt, weights);
      const Operators of(mesh, kappa, flow.phi, rho, dt, weights);
      const Real largest = of.largest();
      EXPECT_LE(largest, (1 + 1e-9) * C) << most;
      if (most > 4) {
        EXPECT_GT(largest, 0.3 * C) << "and not much more than is asked for";
      }
      bool any = false;
      for (Index f = 0; f < mesh.n_internal; ++f) any = any || kappa[f] > 0;
      EXPECT_EQ(any, most > 1) << "nothing is implicit below the bound";
    }
  }
}

// (V + K) new = V change: a change that is the same everywhere stays so, and that
// of a flat cell alone is hardly felt.
TEST(Courant, AChangeThatComesAfterIsShared) {
  const Mesh mesh = test::read_box({.n = {4, 4, 6}, .simplex = true, .moved = thin_layer});
  const Uniform flow(mesh);
  const FaceWeights weights(mesh);
  Courant courant(mesh);
  const Real dt = 50 * courant.explicit_part() / flow.largest;
  FaceField<Real> kappa(mesh);
  courant.add_implicit(kappa, flow.phi, 1, dt, weights);
  CellField<Vec3> change(mesh, Vec3{1, 2, 3});
  courant.share(change, kappa, dt, weights);
  for (Index c = 0; c < mesh.n_cells; ++c) EXPECT_LT(norm(change[c] - Vec3{1, 2, 3}), 1e-12);
  // The fastest cell has fifty times C.
  Index fastest = 0;
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (courant_rate(flow.phi, mesh, c) > courant_rate(flow.phi, mesh, fastest)) fastest = c;
  if (courant_rate(flow.phi, mesh, fastest) < (1 - 1e-9) * flow.largest) fastest = mesh.n_cells;
  for (Index c = 0; c < mesh.n_owned; ++c) change[c] = {c == fastest ? 1.0 : 0.0, 0, 0};
  mesh.halo.update(change);
  courant.share(change, kappa, dt, weights);
  if (fastest < mesh.n_cells) {
    // Several cells are as fast. One beside another of them keeps less than half, one alone less
    // than a hundredth: which is tested depends on the order of the cells.
    EXPECT_LT(change[fastest].x, 0.5);
  }
}

}  // namespace
}  // namespace fsi::flow
