// A particle between plates that slide against each other: fsi-shear [case.yaml] [options]. -help

#include "libfsi/fsi.hpp"

namespace fsi {

RunStatus body() {
  // 1 parameters
  Options options("fsi-shear", "flow between two plates that slide against each other");
  Case setup = read_case(options, "shear");
  const Real rate = options.real("shear_rate", 1,
                                 {.help = "du/dy of the flow between patches bottom and top",
                                  .unit = "1 / time",
                                  .positive = true});
  if (options.help()) return RunStatus::complete;
  options.check_unknown();

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh(setup.mesh);
  const auto shear = [rate](const Vec3& x) { return Vec3{rate * x.y, 0, 0}; };
  setup.flow.conditions = {{"top", Wall{shear(centre(mesh, "top"))}},
                           {"bottom", Wall{shear(centre(mesh, "bottom"))}}};
  for (const Patch& patch : mesh.patches)
    if (patch.name == "back" || patch.name == "front") setup.flow.conditions[patch.name] = Slip{};
  const Real length = setup.solids.empty() ? 1 : thickness_in(mesh.dim, setup.solids[0]) / 2;
  describe(setup, mesh, length, rate * length);

  // 3 solver and initial state
  Solver solver(mesh, setup.physics, setup.flow);
  solver.start(shear);
  put_solids(solver, setup);

  // 4 what to write
  Output output(setup, options, solver, "shear");

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
