// The mean velocity is held to round-off.

#include "libfsi/flow/forcing.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/box_file.hpp"

namespace fsi::flow {
namespace {

TEST(Forcing, HoldsTheMean) {
  const Mesh mesh = test::read_box({.n = {8, 4, 0}, .periodic = {"left", "right"}});
  const FaceWeights weights(mesh);
  const auto conditions = resolve({{"top", Wall{}}, {"bottom", Wall{}}}, mesh);
  Projection projection(mesh, weights, conditions, Method::direct, 0);
  Forcing forcing(mesh, projection, {2, 0, 0}, 1.5);
  CellField<Vec3> u(mesh);
  FaceField<Real> phi(mesh);
  const Real rho = 2, dt = 0.1;
  forcing.hold(u, phi, rho, 0, dt);
  EXPECT_NEAR(mean_velocity(phi, {1, 0, 0}, mesh), 1.5, 1e-14);
  EXPECT_NEAR(forcing.gradient, rho * 1.5 / dt, 1e-11);  // what takes rest there in a step
  Real worst = 0;
  for (Index c = 0; c < mesh.n_cells; ++c) worst = std::max(worst, norm(u[c] - Vec3{1.5, 0, 0}));
  EXPECT_LT(global_max(worst), 1e-12);
  EXPECT_LT(divergence_max(phi, mesh), 1e-12);
  const Real before = forcing.gradient;
  forcing.hold(u, phi, rho, 0, dt);
  EXPECT_NEAR(forcing.gradient, before, 1e-12);
  for (Index f = 0; f < mesh.n_internal; ++f) phi[f] *= 0.9;
  forcing.hold(u, phi, rho, 70, dt);
  EXPECT_NEAR(forcing.gradient, before + (rho / dt + 70) * 0.15, 1e-11);
}

// In a wavy channel a part of the uniform force is a gradient, whose pressure comes with it:
// u_1 = axis - grad q_1.
TEST(Forcing, GivesThePressureOfAChange) {
  const Mesh mesh =
      test::read_box({.n = {16, 8, 0}, .periodic = {"left", "right"}, .moved = [](const Vec3& x) {
                        return Vec3{x.x, x.y * (1 + 0.2 * std::sin(6.283185307179586 * x.x)), 0};
                      }});
  const FaceWeights weights(mesh);
  const auto conditions = resolve({{"top", Wall{}}, {"bottom", Wall{}}}, mesh);
  Projection projection(mesh, weights, conditions, Method::direct, 2);
  Forcing forcing(mesh, projection, {1, 0, 0}, 1);
  CellField<Vec3> u(mesh), grad(mesh);
  FaceField<Real> phi(mesh);
  CellField<Real> p(mesh);
  const Real change = forcing.hold(u, phi, 1, 0, 1);
  forcing.add_pressure(p, change);
  projection.set_gradient(grad, p, BoundaryField<Real>(mesh));
  Real worst = 0, most = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    worst = std::max(worst, norm(u[c] - Vec3{change, 0, 0} + grad[c]));
    most = std::max(most, norm(grad[c]));
  }
  EXPECT_GT(global_max(most), 0.1);
  EXPECT_LT(global_max(worst), 1e-9);
}

TEST(Forcing, TheMeanIsThatOfTheVelocityOnAnyMesh) {
  const Vec3 u{1, 0.5, 0};
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {5, 4, 0}, .length = {2, 1, 1}, .simplex = simplex});
    FaceField<Real> phi(mesh);
    for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = dot(u, mesh.Sf[f]);
    EXPECT_NEAR(mean_velocity(phi, {1, 0, 0}, mesh), 1, 1e-14);
    EXPECT_NEAR(mean_velocity(phi, {0, 1, 0}, mesh), 0.5, 1e-14);
  }
}

}  // namespace
}  // namespace fsi::flow
