// An interface carried by a known velocity: fsi-advect [case.yaml] [options]. -help lists them.

#include "libfsi/fsi.hpp"

namespace fsi {

Ending body() {
  // 1 parameters
  Options options("fsi-advect", "an interface carried by a known velocity");
  const Case which = read_case(options, "advect");
  const std::string name =
      options.choice("velocity", "vortex", vof::motion_names(), "what carries the interface");
  if (options.help()) return Ending::complete;
  options.check_unknown();
  require(which.solid.shape.has_value(), "option -solid_shape is missing: what is carried");

  // 2 mesh and velocity
  const Mesh mesh = read_mesh(which.mesh);
  const vof::Motion motion = vof::motion(name);
  describe(which, mesh, 1, 1);

  // 3 the interface
  Carried carried(mesh, motion, *which.solid.shape);

  // 4 what to write
  CarriedOutput output(which, options, carried);

  // 5 time
  Clock clock(std::min(which.time.end, motion.period));
  while (clock.running() && output.go_on()) {
    const Limit limit{carried.stable_dt(which.time.courant), "advective"};
    carried.step(clock.step(limit.dt, output.next_event()));
    clock.set(carried.t());
    output.after_step();
  }
  return output.finish();
}

}  // namespace fsi

int main(int argc, char** argv) { return fsi::run(argc, argv, fsi::body); }
