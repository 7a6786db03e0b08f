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
  forcing.hold(u, phi, rho, dt);
  EXPECT_NEAR(forcing.mean(phi), 1.5, 1e-14);
  EXPECT_NEAR(forcing.gradient, rho * 1.5 / dt, 1e-11);  // what takes rest there in a step
  Real worst = 0;
  for (Index c = 0; c < mesh.n_cells; ++c) worst = std::max(worst, norm(u[c] - Vec3{1.5, 0, 0}));
  EXPECT_LT(global_max(worst), 1e-12);
  EXPECT_LT(divergence_max(phi, mesh), 1e-12);
  const Real before = forcing.gradient;
  forcing.hold(u, phi, rho, dt);
  EXPECT_NEAR(forcing.gradient, before, 1e-12);
}

}  // namespace
}  // namespace fsi::flow
