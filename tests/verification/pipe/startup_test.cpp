// The flow in a pipe at constant flow rate from a plug profile, against its exact series:
//   u / <u> = 2 (1 - e^2) + sum_n A_n [J0(b_n e) - J0(b_n)] exp(-b_n^2 nu t / R^2), J2(b_n) = 0,
//   A_n = 4 / (b_n^2 J0(b_n)),  e = r / R,
//   S = rho nu <u> / R^2 (8 - sum_n 4 exp(-b_n^2 nu t / R^2))
// (the plug expanded in the eigenfunctions of zero flow rate).

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

constexpr Real nu = 0.01, mean = 0.5, R = 0.5;

/// Positive zeros of J2: by bisection, one in each interval between pi (n + 1/2) and pi (n + 3/2).
std::vector<Real> zeros_of_J2(int count) {
  std::vector<Real> zeros;
  for (int n = 1; n <= count; ++n) {
    Real low = std::numbers::pi * (n + 0.5), high = low + std::numbers::pi;
    const bool rises = std::cyl_bessel_j(2.0, low) < 0;
    for (int i = 0; i < 60; ++i) {
      const Real middle = (low + high) / 2;
      ((std::cyl_bessel_j(2.0, middle) < 0) == rises ? low : high) = middle;
    }
    zeros.push_back(low);
  }
  return zeros;
}

struct Exact {
  explicit Exact(Real time) : t(time) {}
  Real t;
  std::vector<Real> b = zeros_of_J2(40);

  Real decay(Real b_n) const { return std::exp(-b_n * b_n * nu * t / (R * R)); }
  Real velocity(Real r) const {
    const Real e = r / R;
    Real u = 2 * (1 - e * e);
    for (const Real b_n : b) {
      const Real J0 = std::cyl_bessel_j(0.0, b_n);
      u += 4 / (b_n * b_n * J0) * (std::cyl_bessel_j(0.0, b_n * e) - J0) * decay(b_n);
    }
    return mean * u;
  }
  Real gradient() const {
    Real sum = 8;
    for (const Real b_n : b) sum += 4 * decay(b_n);
    return nu * mean / (R * R) * sum;
  }
};

struct Result {
  Real h = 0, L2 = 0, gradient = 0;  ///< errors, the second relative; velocity in units of 2 <u>
};

Result startup(const std::string& name, Real t_end, int steps) {
  MeshOptions options;
  options.file = std::string(FSI_MESHES) + "/" + name + ".msh";
  options.periodic = {"inlet", "outlet"};
  const Mesh mesh = read_mesh(options);
  Solver solver(mesh, {.rho = 1, .mu_f = nu},
                {.conditions = {{"wall", Wall{}}}, .mean_velocity = mean});
  solver.start([](const Vec3&) { return Vec3{mean, 0, 0}; });
  for (int i = 0; i < steps; ++i) {
    solver.step(t_end / steps);
    EXPECT_NEAR(solver.mean_velocity(), mean, 1e-12);
  }
  const Exact exact(t_end), middle(t_end - t_end / steps / 2);
  Sum squares;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Vec3 r = mesh.C[c] - Vec3{mesh.C[c].x, 0.5, 0.5};
    squares.add(mesh.V[c] * norm2(solver.state().u[c] - Vec3{exact.velocity(norm(r)), 0, 0}));
  }
  const Result result{std::cbrt(mesh.total_volume / static_cast<Real>(mesh.n_global)),
                      std::sqrt(squares.total() / mesh.total_volume) / (2 * mean),
                      solver.driving_gradient() / middle.gradient() - 1};
  if (rank() == 0)
    std::printf("%s: %lld cells, t %g, %d steps, L2/U0 %.3e, S %.6f (exact %.6f, %+.2e)\n",
                name.c_str(), static_cast<long long>(mesh.n_global), t_end, steps, result.L2,
                solver.driving_gradient(), middle.gradient(), result.gradient);
  return result;
}

void compare(const std::string& coarse, const std::string& fine, Real t_end, int steps) {
  const Result a = startup(coarse, t_end, steps), b = startup(fine, t_end, steps);
  const Real order = std::log(a.L2 / b.L2) / std::log(a.h / b.h);
  if (rank() == 0) std::printf("order of u: %.2f\n", order);
  EXPECT_GE(order, 1.8);
  EXPECT_LE(b.L2, 3e-3);
  EXPECT_LE(std::abs(b.gradient), 1e-2);
}

TEST(PipeStartup, HexesDuringStartUp) { compare("pipe16", "pipe32", 1, 100); }
TEST(PipeStartup, HexesDeveloped) { compare("pipe16", "pipe32", 3, 300); }
TEST(PipeStartup, FineDuringStartUp) { compare("pipe32", "pipe48", 1, 200); }
TEST(PipeStartup, FineDeveloped) { compare("pipe32", "pipe48", 3, 300); }
TEST(PipeStartup, Prisms) {
  const Result r = startup("prism32", 3, 300);
  EXPECT_LE(r.L2, 3e-3);
  EXPECT_LE(std::abs(r.gradient), 1e-2);
}

}  // namespace
}  // namespace fsi
