// Flow on tetrahedra as gmsh makes them: order, energy, and that nothing grows.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/flow/convection.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/flow_errors.hpp"

namespace fsi {
namespace {

constexpr Real pi = std::numbers::pi, mu = 0.01;
const std::vector<std::string> all_sides{"left", "right", "bottom", "top", "back", "front"};

std::string file(const std::string& name) { return std::string(FSI_MESHES) + "/" + name + ".msh"; }

// The flow of Arnold, Beltrami and Childress, whose convection is a gradient:
//   u = exp(-nu k^2 t) (sin kz + cos ky, sin kx + cos kz, sin ky + cos kx),  p = -rho u^2 / 2
Vec3 abc(const Vec3& x, Real t) {
  constexpr Real k = 2 * pi;
  return std::exp(-mu * k * k * t) * Vec3{std::sin(k * x.z) + std::cos(k * x.y),
                                          std::sin(k * x.x) + std::cos(k * x.z),
                                          std::sin(k * x.y) + std::cos(k * x.x)};
}

Real abc_pressure(const Vec3& x, Real t) { return -norm2(abc(x, t)) / 2; }

test::Errors run_abc(const std::string& name, Real end = 0.25) {
  const Mesh mesh = read_mesh({.file = file(name), .periodic = {}});
  Solver solver(mesh, {.rho = 1, .mu_f = mu}, {});
  solver.start([](const Vec3& x) { return abc(x, 0); });
  // All steps alike: a short last one would show in its pressure.
  const int steps = static_cast<int>(std::ceil(end / solver.advective_dt(0.5)));
  for (int i = 0; i < steps; ++i) solver.step(end / steps);
  return test::relative_errors(solver, abc, abc_pressure, end / steps);
}

void expect_orders(const std::string& coarse_name, const std::string& fine_name, Real finer) {
  const test::Errors coarse = run_abc(coarse_name), fine = run_abc(fine_name);
  const Real order = std::log(coarse.u / fine.u) / std::log(finer),
             p_order = std::log(coarse.p / fine.p) / std::log(finer);
  std::printf("ABC flow, %s and %s: u %.2e %.2e order %.2f, p %.2e %.2e order %.2f\n",
              coarse_name.c_str(), fine_name.c_str(), coarse.u, fine.u, order, coarse.p, fine.p,
              p_order);
  EXPECT_GE(order, 1.8);
  EXPECT_GE(p_order, 1);
}

TEST(Tets, AbcFlowIsOfSecondOrder) { expect_orders("tets8", "tets16", 2); }
TEST(Tets, FineAbcFlowIsOfSecondOrder) { expect_orders("tets16", "tets24", 1.5); }
TEST(Tets, FineAbcFlowKeepsItsOrder) {
  std::vector<test::Errors> off;
  for (const char* name : {"tets6", "tets12", "tets24"}) {
    off.push_back(run_abc(name, 0.5));
    std::printf("ABC flow to t = 0.5, %s: u %.2e, p %.2e\n", name, off.back().u, off.back().p);
  }
  for (std::size_t i = 1; i < off.size(); ++i) {
    EXPECT_GE(std::log2(off[i - 1].u / off[i].u), 1.8);
    EXPECT_GE(std::log2(off[i - 1].p / off[i].p), 1);
  }
}

Real energy(const Solver& solver) {
  Sum sum;
  for (Index c = 0; c < solver.mesh().n_owned; ++c)
    sum.add(solver.mesh().V[c] * norm2(solver.state().u[c]) / 2);
  return sum.total();
}

// Without viscosity the flow decays by its own damping alone; energy must not grow in any step.
TEST(Tets, EnergyNeverGrowsWithoutViscosity) {
  for (const std::string name : {"tets8", "slivers8"})
    for (const std::string& scheme : flow::convection_names()) {
      const Mesh mesh = read_mesh({.file = file(name), .periodic = {}});
      Solver solver(mesh, {.rho = 1, .mu_f = 1e-300}, {.convection = flow::convection_of(scheme)});
      solver.start([](const Vec3& x) {
        constexpr Real k = 2 * pi;
        return Vec3{std::sin(k * x.x) * std::cos(k * x.y) * std::cos(k * x.z),
                    -std::cos(k * x.x) * std::sin(k * x.y) * std::cos(k * x.z), 0};
      });
      const Real first = energy(solver);
      Real last = first, growth = 0;
      while (solver.state().t < 2) {
        solver.step(solver.advective_dt(0.3));
        const Real now = energy(solver);
        growth = std::max(growth, now / last - 1), last = now;
      }
      std::printf("Taylor-Green without viscosity, %s, %s: energy %.4f of its start at t = 2\n",
                  name.c_str(), scheme.c_str(), last / first);
      EXPECT_LE(growth, 1e-4) << name << " " << scheme;
      EXPECT_LE(last, first);
    }
}

/// What a run without viscosity made of its energy, as parts of that at its start.
struct Balance {
  Real change = 0, growth = 0;  ///< at the end; the largest in a step
};

/// A vortex sin kx cos ky to `end`, convection symmetric, projection orthogonal, all sides slip.
Balance run_vortex(const Mesh& mesh, Real k, Real end, Real courant) {
  Conditions conditions;
  for (const Patch& patch : mesh.patches) conditions[patch.name] = Slip{};
  Solver solver(mesh, {.rho = 1, .mu_f = 1e-300},
                {.conditions = conditions,
                 .convection = flow::Convection::symmetric,
                 .orthogonal_projection = true});
  solver.start([k](const Vec3& x) {
    return Vec3{std::sin(k * x.x) * std::cos(k * x.y), -std::cos(k * x.x) * std::sin(k * x.y), 0};
  });
  const Real first = energy(solver), dt = solver.advective_dt(courant);
  Balance balance;
  for (Real last = first; solver.state().t < end;) {
    solver.step(dt);
    const Real now = energy(solver);
    balance = {now / first - 1, std::max(balance.growth, now / last - 1)};
    last = now;
  }
  std::printf("vortex, %d cells, Courant number %.1f: energy %+.1e, at most %+.1e in a step\n",
              mesh.n_owned, courant, balance.change, balance.growth);
  return balance;
}

// Only the steps change the energy: less than a thousandth, and the less the shorter they are.
TEST(Tets, OrthogonalProjectionKeepsEnergy) {
  const Mesh mesh = read_mesh({.file = file("tets8"), .periodic = {}});
  const Balance coarse = run_vortex(mesh, 2 * pi, 2, 0.5), fine = run_vortex(mesh, 2 * pi, 2, 0.25);
  EXPECT_LE(std::abs(coarse.change), 1e-3);
  EXPECT_LE(4 * std::abs(fine.change), std::abs(coarse.change));
  EXPECT_LE(coarse.growth, 3e-4);  // in the first step, of Euler; it goes with dt^2
}

TEST(Tets, OrthogonalProjectionKeepsEnergyBesideSlip) {
  const Mesh mesh = read_mesh({.file = file("slivers8_box"), .periodic = {}});
  const Balance balance = run_vortex(mesh, pi, 0.3, 0.4);
  EXPECT_LE(std::abs(balance.change), 1e-4);
}

TEST(Tets, OrthogonalProjectionIsForAFluidAloneAndNoPressureGiven) {
  const Mesh mesh = read_mesh({.file = file("slivers8_box"), .periodic = {}});
  Conditions conditions;
  for (const std::string& side : all_sides) conditions[side] = Wall{};
  Solver solver(mesh, {}, {.conditions = conditions, .orthogonal_projection = true});
  EXPECT_THROW(solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0.5})}),
               Error);
  conditions["right"] = Opening{};
  EXPECT_THROW(Solver(mesh, {}, {.conditions = conditions, .orthogonal_projection = true}), Error);
}

// A lid slides over a box of ten thousand flat and skewed cells, at Re = 1000.
TEST(Tets, ALidOverSliversRejectsNoStep) {
  const Mesh mesh = read_mesh({.file = file("slivers8_box"), .periodic = {}});
  Conditions conditions;
  for (const std::string& side : all_sides) conditions[side] = Wall{};
  conditions["top"] = Wall{{1, 0, 0}};
  Solver solver(mesh, {.rho = 1, .mu_f = 1e-3}, {.conditions = conditions});
  solver.start([](const Vec3&) { return Vec3{}; });
  while (solver.state().t < 10)
    solver.step(std::min(solver.advective_dt(0.5), solver.boundary_dt(0.5)));
  Real fastest = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) fastest = std::max(fastest, norm(solver.state().u[c]));
  std::printf("lid over slivers at Re 1000: energy %.4f, largest speed %.3f at t = 10\n",
              energy(solver), global_max(fastest));
  EXPECT_LE(global_max(fastest), 1);
}

}  // namespace
}  // namespace fsi
