// Flow through an empty stenosis (diameter 1 narrowing to 0.5, nu = 0.01) against an axisymmetric
// Newton solution, Chebyshev across and fourth order along the axis, converged to 1e-5: a parabola
// of mean velocity 0.438989 (throat of length 6) or 0.658257 (length 2) enters, and the pressure on
// the axis falls by 5.5 from x = 0 to x = 6. The reference ends there in a condition of its own (no
// change of the stream function), which raises its drop: with the outlet moved to x = 8 the same
// flow loses 5.428 and 5.393 from x = 0 to x = 6, and 5.581 and 5.564 to x = 8. The fall from x = 0
// to x = 5 does not feel it (5.55265 and 5.56614, the same to 5e-7 for both outlets), and a mesh
// can be judged by it.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

constexpr Real nu = 0.01, pressure = 5.5;

Real mean_velocity(int throat) { return throat == 6 ? 0.438988980 : 0.658257; }
Real flow_rate(int throat) { return throat == 6 ? 0.344781 : 0.516994; }
Real drop_to_5(int throat) { return throat == 6 ? 5.55265 : 5.56614; }

Mesh mesh_of(int n, int throat) {
  MeshOptions options;
  options.file = std::string(FSI_MESHES) + "/stenosis" + std::to_string(n) + "_" +
                 std::to_string(throat) + ".msh";
  return read_mesh(options);
}

void run(Solver& solver, Real t_end) {
  while (solver.state().t < t_end)
    solver.step(std::min({solver.advective_dt(0.5), 0.02, t_end - solver.state().t + 1e-12}));
}

/// Outflow through a patch.
Real flux(const Solver& solver, const std::string& name) {
  const Patch& patch = solver.mesh().patch(name);
  Sum sum;
  for (Index f = patch.begin; f < patch.end; ++f) sum.add(solver.state().phi[f]);
  return sum.total();
}

/// Pressure on the axis at x: linear in x through the mean of the cells around the axis in the two
/// layers next to x.
Real axis_pressure(const Solver& solver, Real h, Real at) {
  const Mesh& mesh = solver.mesh();
  const Real first = at < h ? 0 : at - h;
  std::array<Sum, 6> sums;  // of each layer: p, x, cells
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Vec3 C = mesh.C[c];
    const Real r = std::hypot(C.y - 0.5, C.z - 0.5);
    if (r > 1.1 * h || C.x < first || C.x > first + 2 * h) continue;
    const std::size_t layer = C.x > first + h ? 3 : 0;
    sums[layer].add(solver.state().p[c]), sums[layer + 1].add(C.x), sums[layer + 2].add(1);
  }
  std::array<Real, 6> t{};
  Sum::totals(t, sums);
  const Real p0 = t[0] / t[2], x0 = t[1] / t[2], p1 = t[3] / t[5], x1 = t[4] / t[5];
  return p0 + (at - x0) * (p1 - p0) / (x1 - x0);
}

/// Relative error of the flow rate at the given pressures.
Real flow_error(int n, int throat, Real t_end) {
  const Mesh mesh = mesh_of(n, throat);
  Solver solver(
      mesh, {.rho = 1, .mu_f = nu},
      {.conditions = {{"wall", Wall{}}, {"inlet", Opening{pressure}}, {"outlet", Opening{0}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  run(solver, t_end - 1);
  const Real before = flux(solver, "outlet");
  run(solver, t_end);
  const Real Q = flux(solver, "outlet"), error = Q / flow_rate(throat) - 1;
  if (rank() == 0)
    std::printf(
        "throat %d, %d cells per diameter: Q %.6f (%+.2f %%), change in the last unit of time "
        "%.1e\n",
        throat, n, Q, 100 * error, Q / before - 1);
  EXPECT_NEAR(Q, -flux(solver, "inlet"), 1e-6);
  return error;
}

/// Relative error of the pressure drop under a parabolic inlet profile.
Real drop_error(int n, int throat, Real t_end) {
  const Mesh mesh = mesh_of(n, throat);
  const Real mean = mean_velocity(throat);
  const FixedVelocity parabola{[mean](const Vec3& x, Real) {
    const Real r2 = (x.y - 0.5) * (x.y - 0.5) + (x.z - 0.5) * (x.z - 0.5);
    return Vec3{2 * mean * std::max(0.0, 1 - 4 * r2), 0, 0};
  }};
  Solver solver(mesh, {.rho = 1, .mu_f = nu},
                {.conditions = {{"wall", Wall{}}, {"inlet", parabola}, {"outlet", Opening{0}}}});
  solver.start([mean](const Vec3&) { return Vec3{mean, 0, 0}; });
  const auto drop = [&] {
    return axis_pressure(solver, 1.0 / n, 0) - axis_pressure(solver, 1.0 / n, 5);
  };
  run(solver, t_end - 1);
  const Real before = drop();
  run(solver, t_end);
  const Real p = drop(), error = p / drop_to_5(throat) - 1;
  if (rank() == 0)
    std::printf(
        "throat %d, %d cells per diameter: drop %.5f (%+.2f %%), change in the last unit of time "
        "%.1e\n",
        throat, n, p, 100 * error, p / before - 1);
  return error;
}

TEST(Stenosis, FlowAtGivenPressureLong) { EXPECT_LE(std::abs(flow_error(16, 6, 8)), 0.02); }
TEST(Stenosis, FlowAtGivenPressureShort) { EXPECT_LE(std::abs(flow_error(16, 2, 8)), 0.02); }

TEST(StenosisLong, FlowFine) {
  for (const int throat : {6, 2})
    for (const int n : {24, 32}) EXPECT_LE(std::abs(flow_error(n, throat, 10)), 0.02);
}

TEST(StenosisLong, PressureDropConverges) {
  for (const int throat : {6, 2}) {
    const Real coarse = std::abs(drop_error(16, throat, 10)),
               medium = std::abs(drop_error(24, throat, 10)),
               fine = std::abs(drop_error(32, throat, 10));
    EXPECT_LE(fine, 0.02);
    EXPECT_LT(medium, coarse);
    EXPECT_LT(fine, medium);
    if (rank() == 0) std::printf("throat %d: order %.2f\n", throat, std::log2(coarse / fine));
  }
}

}  // namespace
}  // namespace fsi
