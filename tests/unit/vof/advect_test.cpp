// Planes are reproduced, a slab is carried exactly, the reversed vortex reaches published errors.

#include "libfsi/vof/advect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/vof/fill.hpp"
#include "libfsi/vof/reconstruct.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi::vof {
namespace {

constexpr Real pi = std::numbers::pi;

Real volume(const CellField<Real>& alpha, const Mesh& mesh) {
  Sum sum;
  for (Index c = 0; c < mesh.n_owned; ++c) sum.add(alpha[c] * mesh.V[c]);
  return sum.total();
}

TEST(Reconstruct, APlaneIsReproduced) {
  for (const Index nz : {0, 8}) {
    const Mesh mesh = test::box_mesh({.n = {8, 8, nz}});
    const Vec3 n = Vec3{0.6, 0.7, nz > 0 ? 0.4 : 0} / norm({0.6, 0.7, nz > 0 ? 0.4 : 0});
    const Real s = dot(n, {0.48, 0.53, nz > 0 ? 0.51 : 0});
    CellField<Real> alpha(mesh);
    geometry::Cell cell;
    for (Index c = 0; c < mesh.n_cells; ++c) {
      gather(cell, mesh, c);
      alpha[c] =
          std::clamp(geometry::volume_below(cell, n, s - dot(n, mesh.C[c])) / mesh.V[c], 0.0, 1.0);
    }
    Interface interface(mesh);
    Reconstruct reconstruct(mesh);
    for (int i = 0; i < 4; ++i) reconstruct(interface, alpha);
    Real worst = 0;
    for (const Index c : interface.cells) worst = std::max(worst, norm(interface.normal[c] - n));
    EXPECT_LE(worst, 1e-2);
    std::printf("plane in %s: normal to %.1e\n", nz > 0 ? "hexes" : "quads", worst);
  }
}

/// Shape error sum |alpha - alpha_0| V, relative volume error, worst bound.
struct Errors {
  Real shape = 0, volume = 0, bound = 0;
};

Errors reversed_vortex(Index n, Real period) {
  const Mesh mesh = test::box_mesh({.n = {n, n, 0}});
  CellField<Real> alpha(mesh), start(mesh);
  fill(start, mesh, shapes::translate(shapes::sphere(0.15), {0.5, 0.75, 0}));
  alpha.assign(start);
  FaceField<Real> phi(mesh), phi_max(mesh);
  CellField<Vec3> u(mesh), u_max(mesh);
  CellField<Tensor> L(mesh), L_max(mesh);
  // psi = sin^2(pi x) sin^2(pi y) / pi; u = d psi/dy, v = -d psi/dx up to sign
  const auto psi = [](const Vec3& x) {
    return std::pow(std::sin(pi * x.x) * std::sin(pi * x.y), 2) / pi;
  };
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const Vec3 a = mesh.corner(f, 0, mesh.owner[f]), b = mesh.corner(f, 1, mesh.owner[f]);
    phi_max[f] = psi(b) - psi(a);
    if (dot(mesh.Sf[f], {b.y - a.y, a.x - b.x, 0}) < 0) phi_max[f] *= -1;
  }
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Real x = mesh.C[c].x, y = mesh.C[c].y, sx = std::sin(pi * x), sy = std::sin(pi * y);
    const Real s2x = std::sin(2 * pi * x), s2y = std::sin(2 * pi * y);
    u_max[c] = {sx * sx * s2y, -s2x * sy * sy, 0};
    L_max[c].xx = pi * s2x * s2y, L_max[c].xy = 2 * pi * sx * sx * std::cos(2 * pi * y);
    L_max[c].yx = -2 * pi * std::cos(2 * pi * x) * sy * sy, L_max[c].yy = -pi * s2x * s2y;
  }
  Interface interface(mesh);
  Reconstruct reconstruct(mesh);
  Advect advect(mesh);
  const int steps = static_cast<int>(std::ceil(period * static_cast<Real>(n) / 0.5));
  const Real dt = period / steps;
  Errors errors;
  for (int i = 0; i < steps; ++i) {
    const Real swing = std::cos(pi * (i + 0.5) * dt / period);
    for (Index f = 0; f < mesh.n_faces; ++f) phi[f] = swing * phi_max[f];
    for (Index c = 0; c < mesh.n_cells; ++c) u[c] = swing * u_max[c], L[c] = swing * L_max[c];
    reconstruct(interface, alpha);
    errors.bound = std::max(errors.bound, advect(alpha, interface, phi, u, L, dt).overshoot);
  }
  Sum shape;
  for (Index c = 0; c < mesh.n_owned; ++c) shape.add(std::abs(alpha[c] - start[c]) * mesh.V[c]);
  errors.shape = shape.total();
  errors.volume = std::abs(volume(alpha, mesh) / volume(start, mesh) - 1);
  std::printf("reversed vortex %d^2, T = %g: shape %.3e volume %.1e bound %.1e\n", n, period,
              errors.shape, errors.volume, errors.bound);
  return errors;
}

TEST(Advect, ReversedVortex) {
  const Errors errors = reversed_vortex(128, 8);
  EXPECT_LE(errors.shape, 1.3 * 2.33e-3);  // [Scheufler19], plicRDF on 128^2 squares
  EXPECT_LE(errors.volume, 1e-12);
  EXPECT_LE(errors.bound, 1e-8);
}

}  // namespace
}  // namespace fsi::vof
