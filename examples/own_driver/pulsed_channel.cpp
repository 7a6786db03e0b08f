// Flow between two plates, driven by a force that pulsates: pulsed-channel [case.yaml] [options].
// Adds two columns of its own to flow.csv.

#include <libfsi/fsi.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using fsi::Real;
using fsi::Vec3;

/// The largest speed in the mesh; collective.
Real largest_speed(const fsi::Solver& solver) {
  Real largest = 0;
  for (fsi::Index c = 0; c < solver.mesh().n_owned; ++c)
    largest = std::max(largest, norm(solver.state().u[c]));
  return fsi::global_max(largest);
}

fsi::RunStatus pulsed_channel() {
  // 1 parameters
  fsi::Options options("pulsed-channel", "flow between two plates, driven by a pulsating force");
  fsi::Case setup = fsi::read_case(options, "pulsed-channel");
  const Real mean = options.real("force_mean", 0.08,
                                 {.help = "mean of the force along x", .unit = "force / volume"});
  const Real swing =
      options.real("force_swing", 1, {.help = "amplitude of the force over its mean", .min = 0});
  const Real period = options.real(
      "force_period", 4, {.help = "period of the force", .unit = "time", .positive = true});
  const Real slope = options.real(
      "force_slope", 0, {.help = "growth of the force from plate to plate over its mean"});
  if (options.help()) return fsi::RunStatus::complete;
  options.check_unknown();

  // 2 mesh, boundary conditions and force
  const fsi::Mesh mesh = fsi::read_mesh(setup.mesh);
  setup.flow.conditions = {{"bottom", fsi::Wall{}}, {"top", fsi::Wall{}}};
  const auto force = [=](const Vec3& x, Real t) {
    const Real pulse = 1 + swing * std::cos(2 * std::numbers::pi * t / period);
    return Vec3{mean * pulse * (1 + slope * (x.y - 0.5)), 0, 0};
  };
  setup.flow.body_force = force;
  fsi::describe(setup, mesh, 1, mean / (8 * setup.physics.mu_f));

  // 3 solver and initial state
  fsi::Solver solver(mesh, setup.physics, setup.flow);
  solver.start([](const Vec3&) { return Vec3{}; });
  fsi::put_solids(solver, setup);

  // 4 what to write
  const auto mean_force = [=](const fsi::Solver& s) { return force({0, 0.5, 0}, s.state().t).x; };
  fsi::Output output(setup, options, solver, "pulsed-channel",
                     {{"force", mean_force}, {"largest_speed", largest_speed}});

  // 5 time
  fsi::Clock clock(setup.time.end, solver.state().t);
  while (clock.running() && output.go_on()) {
    const fsi::Limit limit = fsi::stable_dt(solver, setup.time);
    const Real dt = solver.advance(clock.step(limit.dt, output.next_event()));
    clock.set(solver.state().t);
    output.after_step(limit, dt);
  }
  return output.finish();
}

int main(int argc, char** argv) { return fsi::run(argc, argv, pulsed_channel); }
