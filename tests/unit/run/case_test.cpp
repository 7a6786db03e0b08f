// Solids as a case has them, put into a mesh.

#include "libfsi/run/case.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "libfsi/core/error.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi {
namespace {

TEST(PutSolids, APlaneCutsASolidThroughItsCentreWhateverItsHeight) {
  const Mesh mesh = test::box_mesh({.n = {16, 16, 0}, .periodic = {true, true, false}});
  for (const Real z : {0.0, 0.19, 7.5}) {
    SolidSetup disc;
    disc.solid.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, z});
    disc.shape_name = "sphere";
    disc.centre_z = z;
    Case setup;
    setup.solids = {disc};
    Solver solver(mesh, {}, {});
    solver.start([](const Vec3&) { return Vec3{}; });
    put_solids(solver, setup);
    EXPECT_NEAR(solver.body()->filled.volume, 0.04 * std::numbers::pi, 1e-3) << z;
  }
}

TEST(Differences, AnotherShapeIsRefused) {
  EXPECT_EQ(differences("solid_radius 1\ntime 2\n", "solid_radius 1\ntime 2\n"), "");
  EXPECT_NE(differences("solid_density 1\n", "solid_density 2\n").find("-solid_density 2 (was 1)"),
            std::string::npos);
  EXPECT_THROW(differences("solids_a_center 1,0,0\n", "solids_a_center 2,0,0\n"), Error);
}

}  // namespace
}  // namespace fsi
