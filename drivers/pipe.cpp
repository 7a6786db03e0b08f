// Flow through a periodic pipe at constant mean velocity: fsi-pipe [case.yaml] [options]. -help

#include "libfsi/fsi.hpp"

namespace fsi {

Ending body() {
  // 1 parameters
  Options options("fsi-pipe", "flow through a periodic pipe at constant mean velocity");
  Case which = read_case(options, "pipe", {1, 0, 0});
  const Real mean = options.real("flow_mean_velocity", 0.5,
                                 {.help = "along x, held exactly", .unit = "velocity"});
  if (options.help()) return Ending::complete;
  options.check_unknown();

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh(which.mesh);
  which.flow.conditions = {{"wall", Wall{}}};
  for (const Patch& patch : mesh.patches)
    if (patch.name == "symmetry") which.flow.conditions["symmetry"] = Slip{};
  which.flow.mean_velocity = mean;
  describe(which, mesh, 1, 2 * mean);

  // 3 solver and initial state
  Solver solver(mesh, which.physics, which.flow);
  solver.start([mean](const Vec3&) { return Vec3{mean, 0, 0}; });
  if (which.solid.shape) solver.put_solid(*which.solid.shape, which.solid.kinematics);

  // 4 what to write
  Output output(which, options, solver, "pipe");

  // 5 time
  Clock clock(which.time.end, solver.state().t);
  while (clock.running() && output.go_on()) {
    const Limit limit = stable_dt(solver, which.time);
    const Real dt = solver.advance(clock.step(limit.dt, output.next_event()));
    clock.set(solver.state().t);
    output.after_step(limit, dt);
  }
  return output.finish();
}

}  // namespace fsi

int main(int argc, char** argv) { return fsi::run(argc, argv, fsi::body); }
