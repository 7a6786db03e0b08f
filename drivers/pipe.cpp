// Flow through a periodic pipe at constant mean velocity: fsi-pipe [case.yaml] [options]. -help

#include "libfsi/fsi.hpp"

namespace fsi {

RunStatus body() {
  // 1 parameters
  Options options("fsi-pipe", "flow through a periodic pipe at constant mean velocity");
  Case setup = read_case(options, "pipe", {1, 0, 0});
  const Real mean =
      options.real("flow_mean_velocity", 0.5,
                   {.help = "mean velocity along x, held exactly", .unit = "velocity"});
  const Real frame = options.real(
      "flow_frame_velocity", 0,
      {.help =
           "velocity along x of the frame that mesh and results stand in; pipe straight along x",
       .unit = "velocity"});
  if (options.help()) return RunStatus::complete;
  options.check_unknown();

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh(setup.mesh);
  require_period_along_x(mesh);
  setup.flow.conditions = {{"wall", Wall{{-frame, 0, 0}}}};
  for (const Patch& patch : mesh.patches)
    if (patch.name == "symmetry") setup.flow.conditions["symmetry"] = Slip{};
  setup.flow.frame = {frame, 0, 0};
  setup.flow.mean_velocity = mean - frame;
  describe(setup, mesh, width_across(mesh, 0), (mesh.dim == 2 ? 1.5 : 2) * mean);

  // 3 solver and initial state
  Solver solver(mesh, setup.physics, setup.flow);
  solver.start([=](const Vec3&) { return Vec3{mean - frame, 0, 0}; });
  put_solids(solver, setup);

  // 4 what to write
  Output output(setup, options, solver, "pipe");

  // 5 time
  Clock clock(setup.time.end, solver.state().t);
  while (clock.running() && output.go_on()) {
    const Limit limit = stable_dt(solver, setup.time);
    const Real dt = solver.advance(clock.step(limit.dt, output.next_event()));
    clock.set(solver.state().t);
    output.after_step(limit, dt);
  }
  return output.finish();
}

}  // namespace fsi

int main(int argc, char** argv) { return fsi::run(argc, argv, fsi::body); }
