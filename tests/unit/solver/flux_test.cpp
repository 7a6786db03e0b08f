// The predicted face flux.

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/flow/projection.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// A stress s that alternates from cell to cell along x: c_f = 2 s, no pressure. The flux strains
// what it passes through, psi = -2 du/dx dt, and G psi is what that takes off s: no more than s
// itself, however long the step; without the bound, by kappa alone, more.
TEST(Flux, StrainsNoMoreOffThanThereIs) {
  const Mesh mesh = test::read_box({.n = {8, 8, 0}});
  const FaceWeights weights(mesh);
  const Real G = 10, s = 1, d = 0.125;
  CellField<Vec3> u(mesh), grad_p(mesh);
  CellField<Real> p(mesh);
  BoundaryField<Vec3> u_b(mesh);
  BoundaryField<Real> p_b(mesh);
  FaceField<Real> phi(mesh), rhie_chow_source(mesh, 2 * s), mu(mesh), kappa(mesh), theta(mesh, 0.5),
      stiffness(mesh);
  const std::vector<char> open(static_cast<std::size_t>(mesh.n_boundary()), 0);
  for (const Real dt : {1e-4, 1e-2, 1.0}) {
    kappa.fill(0.3 * dt * G), stiffness.fill(dt * G);
    const auto taken_off = [&](const FaceField<Real>* strains) {
      flow::predict_flux(phi, u, u_b, open,
                         {.L_f = {},
                          .p = p,
                          .grad_p = grad_p,
                          .grad_p_f = {},
                          .p_b = p_b,
                          .rhie_chow_source = rhie_chow_source,
                          .mu = mu,
                          .theta = theta,
                          .kappa = kappa,
                          .rho = 1,
                          .dt = dt,
                          .stiffness = strains},
                         weights, mesh);
      const Real in = phi[0] / norm(mesh.Sf[0]);  // as much enters on the other side
      return G * 2 * (2 * in / d) * dt / s;
    };
    const Real x = 8 * dt * dt * G / (d * d);
    EXPECT_NEAR(taken_off(&stiffness), x / (1 + 0.15 * x + x), 1e-12 * x);
    EXPECT_NEAR(taken_off(nullptr), x / (1 + 0.15 * x), 1e-12 * x);
    EXPECT_LE(taken_off(&stiffness), 1);
  }
}

}  // namespace
}  // namespace fsi
