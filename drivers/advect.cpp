// An interface carried by a known velocity: fsi-advect [case.yaml] [options]. -help lists them.

#include "libfsi/fsi.hpp"

namespace fsi {

RunStatus body() {
  // 1 parameters
  Options options("fsi-advect", "an interface carried by a known velocity");
  const Case setup = read_case(options, "advect");
  const std::string name = options.choice(
      "velocity", "vortex", vof::motion_names(),
      "what carries the interface, for a period at most: 8, 3 and 2 pi units of time");
  if (options.help()) return RunStatus::complete;
  options.check_unknown();
  require(setup.solids.size() == 1, "one shape is carried: give -solid_shape");

  // 2 mesh and velocity
  const Mesh mesh = read_mesh(setup.mesh);
  const vof::Motion motion = vof::motion(name);
  describe(setup, mesh, 1, 1);

  // 3 the interface
  PrescribedAdvection carried(mesh, motion, shape_in(mesh.dim, setup.solids[0]),
                              setup.solids[0].solid.trim);

  // 4 what to write
  PrescribedAdvectionOutput output(setup, options, carried);

  // 5 time
  Clock clock(std::min(setup.time.end, motion.period));
  while (clock.running() && output.go_on()) {
    const Limit limit{carried.stable_dt(setup.time.courant), "advective"};
    carried.step(clock.step(limit.dt, output.next_event()));
    clock.set(carried.t());
    output.after_step();
  }
  return output.finish();
}

}  // namespace fsi

int main(int argc, char** argv) { return fsi::run(argc, argv, fsi::body); }
