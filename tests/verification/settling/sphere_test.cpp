// A stiff sphere of radius a settles along the middle of a round tube of radius R, slowly, in a
// fluid that does not flow in the mean. With k = a / R it does so at
//   U = U_0 / K,  U_0 = 2 (rho_s - rho_f) g a^2 / (9 mu)  (Stokes),
//   K = (1 - 0.75857 k^5) / (1 - 2.1050 k + 2.0865 k^3 - 1.7068 k^5 + 0.72603 k^6) [Haberman58],
// by less than half a percent too fast at k = 0.4.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/energy.hpp"
#include "tests/verification/settling/settle.hpp"

namespace fsi {
namespace {

constexpr Real a = 0.2, R = 0.5, mu = 1, G = 50;

/// The same weight, and so the same speed, at all ratios.
Real gravity(Real ratio) { return 10 / std::abs(ratio - 1); }

Real exact(Real ratio) {
  const Real k = a / R, k3 = k * k * k, k5 = k3 * k * k;
  const Real K =
      (1 - 0.75857 * k5) / (1 - 2.1050 * k + 2.0865 * k3 - 1.7068 * k5 + 0.72603 * k5 * k);
  return 2 * (ratio - 1) * gravity(ratio) * a * a / (9 * mu) / K;
}

/// Speed over the exact one in the tube of that file, of length 2.
Real speed(Real ratio, const std::string& name) {
  MeshOptions options;
  options.file = std::string(FSI_MESHES) + "/" + name + ".msh";
  options.periodic = {"inlet", "outlet"};
  const Mesh mesh = read_mesh(options);
  Solver solver(mesh, {.mu_f = mu, .gravity = {gravity(ratio), 0, 0}},
                {.conditions = {{"wall", Wall{}}}, .mean_velocity = 0});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(a), {0.8, 0.5, 0.5}),
                    .G = G,
                    .mu = mu,
                    .rho = ratio});
  constexpr Real end = 0.3;
  const Real u = test::settled_speed(solver, end, 60);
  if (rank() == 0)
    std::printf(
        "sphere of density %g in the tube %s: U %.5f after %lld steps, over the exact %.4f\n",
        ratio, name.c_str(), u, static_cast<long long>(solver.state().step), u / exact(ratio));
  return u / exact(ratio);
}

// A stiff sphere that falls through less than a cell: waves of its stress must not grow.
TEST(SettlingSphere, StaysInShapeOnTetrahedra) {
  MeshOptions options;
  options.file = std::string(FSI_MESHES) + "/settling_tets.msh";
  const Mesh mesh = read_mesh(options);
  Conditions walls;
  for (const Patch& patch : mesh.patches) walls[patch.name] = Wall{};
  Solver solver(mesh, {.mu_f = 0.1, .gravity = {0, -1, 0}}, {.conditions = walls});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.25), {0.5, 1.4, 0.5}),
                    .G = 50,
                    .mu = 0.1,
                    .rho = 2});
  Real first = 0;
  for (const Real end : {1.0, 2.5}) {
    test::settled_speed(solver, end, 100);
    const Real energy = elastic_energy(*solver.body()),
               least = global_min(solver.body()->eigenvalue_min);
    std::printf(
        "stiff sphere on tetrahedra, t = %g: elastic energy %.2e, smallest eigenvalue %.4f\n",
        solver.state().t, energy, least);
    if (first == 0) first = energy;
    EXPECT_LE(energy, 1.5 * first);
    EXPECT_GE(least, 0.98);
  }
}

TEST(SettlingSphere, Coarse) { EXPECT_NEAR(speed(2, "tube16"), 1, 0.03); }

TEST(SettlingSphere, Fine) {
  for (const Real ratio : {0.5, 2.0, 5.0}) EXPECT_NEAR(speed(ratio, "tube24"), 1, 0.03);
}

}  // namespace
}  // namespace fsi
