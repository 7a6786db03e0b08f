// A driver of one's own: vortices that decay in a periodic square, against the exact solution.
//   gmsh -2 -setnumber n 32 -setnumber lz 0 meshes/box.geo -o box.msh
//   mine/taylor-green -mesh box.msh

#include <libfsi/fsi.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

using fsi::Real;
using fsi::Vec3;

fsi::RunStatus decay() {
  // 1. parameters
  fsi::Options options("taylor-green", "vortices that decay in a periodic square");
  const Real mu = options.real("fluid_viscosity", 0.01, {.help = "viscosity", .positive = true});
  const Real end = options.real("time_end", 0.5, {.help = "time of the end", .positive = true});
  const std::string file = options.text("mesh", "", "a square of side 1, made by box.geo");
  if (options.help()) return fsi::RunStatus::complete;
  options.check_unknown();

  // 2. mesh: no boundary is left, so there are no conditions
  const fsi::Mesh mesh =
      fsi::read_mesh({.file = file, .periodic = {"left", "right", "bottom", "top"}});

  // 3. solver and initial velocity    u = (sin kx cos ky, -cos kx sin ky) F   [TaylorGreen37]
  constexpr Real k = 2 * std::numbers::pi;
  const auto exact = [&](const Vec3& x, Real t) {
    const Real F = std::exp(-2 * mu * k * k * t);
    return F *
           Vec3{std::sin(k * x.x) * std::cos(k * x.y), -std::cos(k * x.x) * std::sin(k * x.y), 0};
  };
  fsi::Solver solver(mesh, {.rho = 1, .mu_f = mu}, {});
  solver.start([&](const Vec3& x) { return exact(x, 0); });

  // 4. the loop
  fsi::Clock clock(end);
  while (clock.running()) {
    const Real dt = clock.step(solver.advective_dt(0.5), end);
    solver.step(dt);
    clock.set(solver.state().t);
  }

  // 5. what came out
  fsi::Sum squares;
  for (fsi::Index c = 0; c < mesh.n_owned; ++c)
    squares.add(mesh.V[c] * norm2(solver.state().u[c] - exact(mesh.C[c], end)));
  const Real error = std::sqrt(squares.total() / mesh.total_volume);
  if (fsi::rank() == 0)
    std::printf("%lld cells, %lld steps: L2 error of the velocity %.3e\n",
                static_cast<long long>(mesh.n_global), static_cast<long long>(solver.state().step),
                error);
  fsi::require(error < 0.02, "the error is larger than this mesh should give: refine it");
  return fsi::RunStatus::complete;
}

int main(int argc, char** argv) { return fsi::run(argc, argv, decay); }
