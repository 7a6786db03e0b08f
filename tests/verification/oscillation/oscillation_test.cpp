// Small free oscillations of a soft disc in a round vessel, against linear theory.
//
// Radius of the disc, G and both densities are 1, both viscosities 0.05, the radius of the vessel
// is R = 3. The disc starts without strain and with the velocity of the streamfunction
//   f(r) sin(m theta),   f = r^m (1 - r^2 / R^2)^2.
// q(t) is the projection of u on it. exact.py computes the numbers of q.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

constexpr int times = 8;                                                           // t = 1, 2, ...
constexpr std::array<Real, times> exact_2 = {0.50857, 0.06343, 0.05036,  0.17282,  // m = 2
                                             0.12757, 0.00543, -0.02088, 0.02339};
constexpr std::array<Real, times> exact_3 = {0.52691, 0.32167, 0.23548, 0.12101,  // m = 3
                                             0.08635, 0.05441, 0.03015, 0.02212};

/// Velocity of the start, over its amplitude.
Vec3 mode(const Vec3& x, int m) {
  constexpr Real R = 3;
  const Real r = std::hypot(x.x, x.y), angle = m * std::atan2(x.y, x.x), q = 1 - r * r / (R * R);
  const Real f_r = std::pow(r, m - 1) * q * q;                        // f / r
  const Real slope = m * f_r - 4 * std::pow(r, m + 1) * q / (R * R);  // f'
  const Real along = m * f_r * std::cos(angle), turn = -slope * std::sin(angle);
  return {(along * x.x - turn * x.y) / r, (along * x.y + turn * x.x) / r, 0};
}

/// The largest error of q.
Real error(const std::string& name, int m) {
  const std::array<Real, times>& exact = m == 2 ? exact_2 : exact_3;
  constexpr Real amplitude = 0.018;  // the surface then moves by 0.02
  const Mesh mesh =
      read_mesh({.file = std::string(FSI_MESHES) + "/" + name + ".msh", .periodic = {}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.05}, {.conditions = {{"wall", Wall{}}}});
  solver.start([&](const Vec3& x) { return amplitude * mode(x, m); });
  solver.put_solid({.shape = shapes::sphere(1), .G = 1, .mu = 0.05});
  Real largest = 0;
  for (int i = 0; i < times; ++i) {
    while (solver.state().t < i + 1 - 1e-9) {
      const Real left = i + 1 - solver.state().t;
      const Real dt = std::min({solver.advective_dt(0.5), solver.elastic_dt(), 0.08});
      solver.advance(left / std::ceil(left / dt));
    }
    Sum product, square;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const Vec3 w = amplitude * mode(mesh.C[c], m);
      product.add(mesh.V[c] * dot(solver.state().u[c], w));
      square.add(mesh.V[c] * norm2(w));
    }
    largest = std::max(largest, std::abs(product.total() / square.total() - exact[i]));
  }
  return largest;
}

void expect(const std::string& kind, int m, Real bound, Real order) {
  const Real coarse = error("round8" + kind, m), fine = error("round16" + kind, m);
  std::printf("mode %d%s: largest error of q %.4f, %.4f, order %.2f\n", m, kind.c_str(), coarse,
              fine, std::log2(coarse / fine));
  EXPECT_LE(fine, bound);
  EXPECT_GE(std::log2(coarse / fine), order);
}

TEST(Oscillation, Quads) {
  expect("", 2, 0.01, 1.5);
  expect("", 3, 0.01, 1.3);
}

TEST(Oscillation, Triangles) {
  expect("_triangles", 2, 0.015, 0.9);
  expect("_triangles", 3, 0.01, 0.9);
}

}  // namespace
}  // namespace fsi
