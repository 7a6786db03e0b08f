// The implicit share of elasticity: its coefficient, and that nothing of the last step stays.

#include "libfsi/solid/semi_implicit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/support/box_file.hpp"

namespace fsi::solid {
namespace {

TEST(SemiImplicitElasticity, KappaIsAShareOfTheStressOfAStep) {
  const Mesh mesh = test::read_box({.n = {6, 6, 0}});
  const FaceWeights weights(mesh);
  CellField<Real> alpha(mesh), lambda(mesh, 3);
  for (Index c = 0; c < mesh.n_cells; ++c) alpha[c] = mesh.C[c].x < 0.5 ? 1 : 0;
  Band band(mesh);
  band.rebuild(alpha, 0.5);
  const FaceField<Real> alpha_f(mesh, 0.5);
  const CellField<Vec3> u(mesh);
  const CellField<Tensor> L(mesh);
  const SimplexZone zone(mesh);
  SemiImplicitElasticity elasticity(mesh, weights, zone);
  FaceField<Real> kappa(mesh);
  CellField<Vec3> force(mesh);
  const Real G = 2, dt = 0.1;
  elasticity.apply(kappa, force, {lambda, alpha_f, u, L, alpha, G, 1, 0.01, dt}, weights, band);
  std::vector<char> in_band(static_cast<std::size_t>(mesh.n_faces), 0);
  for (const Index f : band.faces()) in_band[f] = 1;
  Real worst = 0, left = 0;
  for (Index f = 0; f < mesh.n_faces; ++f)
    worst = std::max(worst, std::abs(kappa[f] - (in_band[f] != 0 ? 0.4 * dt * G * 0.5 * 3 : 0)));
  EXPECT_LT(worst, 1e-15);
  for (Index c = 0; c < mesh.n_cells; ++c) EXPECT_EQ(norm(force[c]), 0);  // at rest
  elasticity.clear(kappa);
  for (Index f = 0; f < mesh.n_faces; ++f) left = std::max(left, std::abs(kappa[f]));
  EXPECT_EQ(left, 0);
}

// h (rho / (G lambda))^(1/2), lambda at least 1; no wave without stiffness.
TEST(ElasticTime, OfTheShearWave) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}});
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_owned; ++c) cells.push_back(c);
  const CellField<Real> stretched(mesh, 4), pressed(mesh, 0.25);
  EXPECT_NEAR(global_min(elastic_time(stretched, 4, 1, mesh, cells)), 0.25 / 4, 1e-14);
  EXPECT_NEAR(global_min(elastic_time(pressed, 4, 1, mesh, cells)), 0.25 / 2, 1e-14);
  EXPECT_GT(elastic_time(stretched, 0, 1, mesh, cells), 1e300);
}

}  // namespace
}  // namespace fsi::solid
