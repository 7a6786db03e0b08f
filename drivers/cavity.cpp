// Flow in a closed cavity whose lid slides: fsi-cavity [case.yaml] [options]. -help lists them.

#include "libfsi/fsi.hpp"

namespace fsi {

Ending body() {
  // 1 parameters
  Options options("fsi-cavity", "flow in a closed cavity whose lid slides");
  Case which = read_case(options, "cavity");
  const Real lid =
      options.real("lid_velocity", 1, {.help = "of patch top, along x", .unit = "velocity"});
  if (options.help()) return Ending::complete;
  options.check_unknown();

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh(which.mesh);
  which.flow.conditions = {{"top", Wall{{lid, 0, 0}}}, {"wall", Wall{}}};
  describe(which, mesh, 1, std::abs(lid));

  // 3 solver and initial state
  Solver solver(mesh, which.physics, which.flow);
  solver.start([](const Vec3&) { return Vec3{}; });
  if (which.solid.shape) solver.put_solid(*which.solid.shape, which.solid.kinematics);

  // 4 what to write
  Output output(which, options, solver, "cavity");

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
