// Flow through a constricted pipe between two pressures: fsi-stenosis [case.yaml] [options]. -help

#include "libfsi/fsi.hpp"

namespace fsi {

RunStatus body() {
  // 1 parameters
  Options options("fsi-stenosis", "flow through a constricted pipe between two pressures");
  Case setup = read_case(options, "stenosis", {1, 0, 0});
  const Real p_in =
      options.real("inlet_pressure", 5.5,
                   {.help = "pressure at patch inlet; the outlet has 0", .unit = "pressure"});
  if (options.help()) return RunStatus::complete;
  options.check_unknown();

  // 2 mesh and boundary conditions
  const Mesh mesh = read_mesh(setup.mesh);
  setup.flow.conditions = {{"wall", Wall{}}, {"inlet", Opening{p_in}}, {"outlet", Opening{0}}};
  for (const Patch& patch : mesh.patches)
    if (patch.name == "symmetry") setup.flow.conditions["symmetry"] = Slip{};
  describe(setup, mesh, width_across(mesh, 0), 0);  // the pressure gives the velocity

  // 3 solver and initial state
  Solver solver(mesh, setup.physics, setup.flow);
  solver.start([](const Vec3&) { return Vec3{}; });
  put_solids(solver, setup);

  // 4 what to write
  Output output(setup, options, solver, "stenosis");

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
