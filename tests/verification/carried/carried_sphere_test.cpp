// A soft sphere at rest in a uniform flow that carries it through a periodic mesh at a slant, three
// cells a radius: exact is that its centre goes with the flow and that nothing strains it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "libfsi/analysis/motion.hpp"
#include "libfsi/analysis/orientation.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

struct Errors {
  Real centre = 0;  ///< distance from where the flow would have carried it, in diameters
  Real aspect = 1;  ///< smallest over largest half-axis that the second moments tell
};

Errors carried(const std::string& name, const std::vector<std::string>& periodic, Real diameters) {
  const Mesh mesh =
      read_mesh({.file = std::string(FSI_MESHES) + "/" + name + ".msh", .periodic = periodic});
  const Vec3 U{1, 0.31, 0.17}, start{1.23, 1.27, 1.21};
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01}, {.conditions = {}});
  solver.start([&](const Vec3&) { return U; });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.5), start), .G = 10, .mu = 0.01});
  const Body& body = solver.bodies().front();
  analysis::Tracker tracker;
  const Vec3 before = analysis::motion(tracker, body.alpha, solver.state().u, mesh).centroid;
  Real next = 0;
  Errors errors;
  while (norm(U) * solver.state().t < diameters) {
    solver.advance(std::min(solver.advective_dt(0.5), solver.elastic_dt()));
    const analysis::Motion motion = analysis::motion(tracker, body.alpha, solver.state().u, mesh);
    errors.centre = norm(motion.centroid - before - body.t * U);
    if (norm(U) * solver.state().t < next) continue;
    const analysis::Surface surface = analysis::isosurface(body.alpha, mesh, tracker.home);
    const analysis::Orientation o = analysis::orientation(surface, tracker.home);
    errors.aspect = std::sqrt(o.value[0] / o.value[2]);
    Real eigenvalue = 1;
    for (Index c = 0; c < mesh.n_owned; ++c)
      if (body.alpha[c] > 0.5)
        eigenvalue = std::min({eigenvalue, body.B[c].xx, body.B[c].yy, body.B[c].zz});
    eigenvalue = global_min(eigenvalue);
    if (rank() == 0)
      std::printf("%s, %5.1f diameters: centre off by %.2e, aspect %.4f, smallest B_ii %.4f\n",
                  name.c_str(), norm(U) * solver.state().t, errors.centre, errors.aspect,
                  eigenvalue);
    next += diameters / 5;
  }
  return errors;
}

const std::vector<std::string> sides{"left", "right", "bottom", "top", "back", "front"};

// The centroid takes a cut cell's part to lie in the middle of the cell: an error of 1e-3.
void expect_carried_on_hexes(Real diameters) {
  const Errors errors = carried("hexes_carried", sides, diameters);
  EXPECT_LE(errors.centre, 2e-3);
  EXPECT_NEAR(errors.aspect, 1, 0.005);
}

// With planes in place of the bend of the surface the sphere is 0.7 % of its way ahead.
void expect_carried_on_tets(Real diameters, Real limit) {
  const Errors errors = carried("tets_carried", {}, diameters);
  EXPECT_LE(errors.centre, limit);
  EXPECT_NEAR(errors.aspect, 1, 0.03);
}

TEST(Carried, Hexes) { expect_carried_on_hexes(4); }
TEST(Carried, Tets) { expect_carried_on_tets(1.5, 3e-3); }
TEST(CarriedFar, HexesAtFirst) { expect_carried_on_hexes(10); }
TEST(CarriedFar, Hexes) { expect_carried_on_hexes(100); }
TEST(CarriedFar, Tets) { expect_carried_on_tets(10, 5e-3); }

}  // namespace
}  // namespace fsi
