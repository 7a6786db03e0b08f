// Pulsatile flow in a pipe between two openings, p = a cos(w t) and 0, against Womersley's solution
// [Womersley55] (8):
//   u = Re[ (a / (i rho w L)) (1 - J_0(i^(3/2) alpha r / R) / J_0(i^(3/2) alpha)) exp(i w t) ]
// with alpha = R sqrt(rho w / mu); and the flow rate given over a section of any outline.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <string>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

using Complex = std::complex<Real>;
constexpr Real w = 2 * std::numbers::pi, radius = 0.5, length = 0.25;

std::string file(const std::string& name) { return std::string(FSI_MESHES) + "/" + name + ".msh"; }

/// Bessel's function of order 0 by its power series: |z| <= 8 here.
Complex J_0(Complex z) {
  Complex sum = 1, term = 1;
  for (int k = 1; k < 60; ++k) sum += term *= -z * z / (4.0 * k * k);
  return sum;
}

struct Womersley {
  explicit Womersley(Real alpha_) : alpha(alpha_), mu(w * radius * radius / (alpha_ * alpha_)) {}
  Real alpha, mu;

  Complex amplitude(Real r) const {
    const Complex i{0, 1}, s = std::pow(i, 1.5) * alpha;
    return 1.0 / (i * w * length) * (1.0 - J_0(s * r / radius) / J_0(s));
  }
  Vec3 u(const Vec3& x, Real t) const {
    const Real r = std::hypot(x.y - 0.5, x.z - 0.5);
    return {std::real(amplitude(r) * std::exp(Complex{0, w * t})), 0, 0};
  }
};

/// Velocity after one period, by that many steps, at every cell of one rank.
CellField<Vec3> after_a_period(const Mesh& mesh, const Womersley& exact, int steps) {
  Solver solver(mesh, {.rho = 1, .mu_f = exact.mu},
                {.conditions = {{"wall", Wall{}},
                                {"inlet", Opening{[](Real t) { return std::cos(w * t); }}},
                                {"outlet", Opening{0}}}});
  solver.start([&](const Vec3& x) { return exact.u(x, 0); });
  for (int i = 0; i < steps; ++i) solver.step(1.0 / steps);
  CellField<Vec3> u(mesh);
  u.assign(solver.state().u);
  return u;
}

template <class Reference>
Real difference(const CellField<Vec3>& u, const Mesh& mesh, Reference&& reference) {
  Sum square;
  for (Index c = 0; c < mesh.n_owned; ++c) square.add(mesh.V[c] * norm2(u[c] - reference(c)));
  return std::sqrt(square.total() / mesh.total_volume);
}

/// Root mean square of the amplitude: errors are told as a part of it.
Real scale(const Mesh& mesh, const Womersley& exact) {
  Sum square;
  for (Index c = 0; c < mesh.n_owned; ++c)
    square.add(mesh.V[c] *
               std::norm(exact.amplitude(std::hypot(mesh.C[c].y - 0.5, mesh.C[c].z - 0.5))));
  return std::sqrt(square.total() / mesh.total_volume);
}

void check(const std::string& name, Real alpha, Real accuracy) {
  const Mesh mesh = read_mesh({.file = file(name), .periodic = {}});
  const Womersley exact(alpha);
  const Real size = scale(mesh, exact);
  const CellField<Vec3> finest = after_a_period(mesh, exact, 640);
  std::array<Real, 2> in_time{};
  for (const int i : {0, 1}) {
    const CellField<Vec3> u = after_a_period(mesh, exact, i == 0 ? 40 : 80);
    in_time[i] = difference(u, mesh, [&](Index c) { return finest[c]; }) / size;
  }
  const Real error =
      difference(finest, mesh, [&](Index c) { return exact.u(mesh.C[c], 1); }) / size;
  const Real order = std::log2(in_time[0] / in_time[1]);
  std::printf(
      "Womersley, %s, alpha %g: error %.2e; of the steps, 40 and 80 a period, %.2e %.2e, "
      "order %.2f\n",
      name.c_str(), alpha, error, in_time[0], in_time[1], order);
  EXPECT_LE(error, accuracy);
  EXPECT_GE(order, 1.8);
}

TEST(Womersley, Alpha2) { check("pulse16", 2, 0.02); }
TEST(Womersley, Alpha8) { check("pulse16", 8, 0.03); }
TEST(Womersley, FineAlpha2) { check("pulse32", 2, 0.01); }
TEST(Womersley, FineAlpha8) { check("pulse32", 8, 0.01); }

// A given flow rate enters a round section as Poiseuille's parabola and stays that.
TEST(FlowRate, EntersASectionAsItsDevelopedFlow) {
  const Mesh mesh = read_mesh({.file = file("pulse_tets"), .periodic = {}});
  const Patch& inlet = mesh.patch("inlet");
  const std::vector<Vec3> shape = inflow_shape(InflowProfile::parabola, inlet, mesh, {});
  const Real peak = 2 / (std::numbers::pi * radius * radius);
  std::array<Sum, 2> sums;
  for (Index f = inlet.begin; f < inlet.end; ++f) {
    const Real r = std::hypot(mesh.Cf[f].y - 0.5, mesh.Cf[f].z - 0.5) / radius;
    sums[0].add(norm(mesh.Sf[f]) * std::pow(shape[f - inlet.begin].x - peak * (1 - r * r), 2));
    sums[1].add(norm(mesh.Sf[f]));
  }
  const Real off = std::sqrt(sums[0].total() / sums[1].total()) / peak;
  std::printf("parabola of a round section of tets, 16 a diameter: off by %.2e of its peak\n", off);
  EXPECT_LE(off, 0.015);
}

}  // namespace
}  // namespace fsi
