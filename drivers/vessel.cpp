// Flow through any vessel, conditions by the patches' names: fsi-vessel [case.yaml] [options].
// -help

#include "libfsi/fsi.hpp"

namespace fsi {

Ending body() {
  // 1 parameters
  Options options("fsi-vessel", "flow through any vessel, conditions by the patches' names");
  Case which = read_case(options, "vessel");
  const Vec3 force =
      options.vec3("flow_body_force", {}, {.help = "on fluid and solid", .unit = "force / volume"});
  if (options.help()) return list_vessel_options(options, which.solid), Ending::complete;

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh(which.mesh);
  which.flow.conditions = read_patches(options, mesh);
  if (norm(force) > 0) which.flow.body_force = [=](const Vec3&, Real) { return force; };
  place_solid(which.solid, options, mesh);
  options.check_unknown();
  describe(which, mesh, 1, 0);

  // 3 solver and initial state
  Solver solver(mesh, which.physics, which.flow);
  solver.start([](const Vec3&) { return Vec3{}; });
  if (which.solid.shape) solver.put_solid(*which.solid.shape, which.solid.kinematics);

  // 4 what to write
  Output output(which, options, solver, "vessel");

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
