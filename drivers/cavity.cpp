// Flow in a closed cavity whose lid slides: fsi-cavity [case.yaml] [options]. -help lists them.

#include "libfsi/fsi.hpp"

namespace fsi {

RunStatus body() {
  // 1 parameters
  Options options("fsi-cavity", "flow in a closed cavity whose lid slides");
  Case setup = read_case(options, "cavity");
  const Real lid = options.real("lid_velocity", 1,
                                {.help = "velocity of patch top, along x", .unit = "velocity"});
  if (options.help()) return RunStatus::complete;
  options.check_unknown();

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh(setup.mesh);
  setup.flow.conditions = {{"top", Wall{{lid, 0, 0}}}, {"wall", Wall{}}};
  describe(setup, mesh, width_across(mesh, 1), std::abs(lid));

  // 3 solver and initial state
  Solver solver(mesh, setup.physics, setup.flow);
  solver.start([](const Vec3&) { return Vec3{}; });
  put_solids(solver, setup);

  // 4 what to write
  Output output(setup, options, solver, "cavity");

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
