// A particle between plates that slide against each other: fsi-shear [case.yaml] [options]. -help

#include "libfsi/fsi.hpp"

namespace fsi {

Ending body() {
  // 1 parameters
  Options options("fsi-shear", "flow between two plates that slide against each other");
  Case which = read_case(options, "shear");
  const Real rate = options.real("shear_rate", 1,
                                 {.help = "du/dy of the flow between patches bottom and top",
                                  .unit = "1 / time",
                                  .positive = true});
  if (options.help()) return Ending::complete;
  options.check_unknown();

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh(which.mesh);
  const auto shear = [rate](const Vec3& x) { return Vec3{rate * x.y, 0, 0}; };
  which.flow.conditions = {{"top", Wall{shear(centre(mesh, "top"))}},
                           {"bottom", Wall{shear(centre(mesh, "bottom"))}}};
  for (const Patch& patch : mesh.patches)
    if (patch.name == "back" || patch.name == "front") which.flow.conditions[patch.name] = Slip{};
  const Real length = which.solid.shape ? which.solid.thickness / 2 : 1;
  describe(which, mesh, length, rate * length);

  // 3 solver and initial state
  Solver solver(mesh, which.physics, which.flow);
  solver.start(shear);
  if (which.solid.shape) solver.put_solid(*which.solid.shape, which.solid.kinematics);

  // 4 what to write
  Output output(which, options, solver, "shear");

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
