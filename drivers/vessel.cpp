// Flow through any vessel, conditions by the patches' names: fsi-vessel [case.yaml] [options].
// -help

#include "libfsi/fsi.hpp"

namespace fsi {

RunStatus body() {
  // 1 parameters
  Options options("fsi-vessel", "flow through any vessel, conditions by the patches' names");
  Case setup = read_case(options, "vessel");
  const Vec3 force = options.vec3("flow_body_force", {},
                                  {.help = "force on fluid and solid", .unit = "force / volume"});
  if (options.help()) return list_vessel_options(options), RunStatus::complete;

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh_and_place(setup, options);
  setup.flow.conditions = read_patches(options, mesh);
  if (norm(force) > 0) setup.flow.body_force = [=](const Vec3&, Real) { return force; };
  options.check_unknown();
  describe(setup, mesh, 1, 0);

  // 3 solver and initial state
  Solver solver(mesh, setup.physics, setup.flow);
  solver.start([](const Vec3&) { return Vec3{}; });
  put_solids(solver, setup);

  // 4 what to write
  Output output(setup, options, solver, "vessel");

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
