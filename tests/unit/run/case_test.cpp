// Solids as a case has them, put into a mesh.

#include "libfsi/run/case.hpp"
#include "libfsi/run/continuation.hpp"

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
    disc.centre = {0.5, 0.5, z};
    Case setup;
    setup.solids = {disc};
    Solver solver(mesh, {}, {});
    solver.start([](const Vec3&) { return Vec3{}; });
    put_solids(solver, setup);
    EXPECT_NEAR(solver.body()->filled.volume, 0.04 * std::numbers::pi, 1e-3) << z;
  }
}

// In a plane the height of a disk about z and an ellipsoid's axis along z do not count.
TEST(Thickness, IsThatOfTheSectionInAPlane) {
  const auto thickness = [](int dim, const shapes::Shape& shape, Real least) {
    const Vec3 centre{0.4, 0.6, 0.3};
    SolidSetup solid;
    solid.solid.shape = shapes::translate(shape, centre);
    solid.centre = centre;
    solid.thickness = least;
    return thickness_in(dim, solid);
  };
  const shapes::Shape disk = shapes::disk(0.2, 0.1), pea = shapes::ellipsoid({0.3, 0.2, 0.05});
  EXPECT_EQ(thickness(3, disk, 0.1), 0.1);
  EXPECT_NEAR(thickness(2, disk, 0.1), 0.1, 1e-9);
  EXPECT_NEAR(thickness(2, shapes::align(disk, {0, 0, 1}), 0.1), 0.4, 1e-9);
  EXPECT_NEAR(thickness(2, pea, 0.1), 0.4, 1e-9);
  EXPECT_EQ(thickness(2, shapes::torus(0.3, 0.1), 0.2), 0.2);
}

// The sizes that nobody gave are told where a solid does not fit, and where it is refused for
// another reason they are not.
TEST(PutSolids, SizesByDefaultAreToldOfWhatDoesNotFit) {
  const Mesh mesh = test::box_mesh({.n = {16, 16, 0}, .periodic = {true, true, false}});
  SolidSetup disc;
  disc.solid.by_default = "-solid_radius 0.2";
  disc.shape_name = "sphere";
  const auto sentence = [&](const Vec3& centre, const FlowSetup& flow, const Vec3& second) {
    Case setup;
    for (const Vec3& place : {centre, second}) {
      disc.solid.shape = shapes::translate(shapes::sphere(0.2), place);
      disc.solid.name = setup.solids.empty() ? "one" : second == Vec3{} ? "one" : "two";
      setup.solids.push_back(disc);
    }
    Solver solver(mesh, {}, flow);
    solver.start([](const Vec3&) { return Vec3{}; });
    try {
      put_solids(solver, setup);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string sizes = "; by default it has -solid_radius 0.2";
  const Vec3 middle{0.5, 0.5, 0};
  EXPECT_EQ(sentence(middle, {}, {0.5, 0.6, 0}),
            "solid \"two\" overlaps solid \"one\" at the start: move one of them" + sizes);
  EXPECT_EQ(sentence({0.5, 0.5, 5}, {}, middle),
            "solid \"one\" is empty: its shape lies outside the mesh or is smaller than a cell" +
                sizes +
                "; the mesh reaches from (0, 0, 0) to (1, 1, 0): look whether it lies within the "
                "fluid, and both are in the same unit");
  EXPECT_EQ(sentence(middle, {}, {}), "two solids have the name \"one\"");
  EXPECT_EQ(sentence(middle, {.orthogonal_projection = true}, {}),
            "an orthogonal projection (-flow_projection) is for a fluid without solids");
}

TEST(Differences, AnotherShapeIsRefused) {
  EXPECT_EQ(differences("solid_radius 1\ntime 2\n", "solid_radius 1\ntime 2\n"), "");
  EXPECT_NE(differences("solid_density 1\n", "solid_density 2\n").find("-solid_density 2 (was 1)"),
            std::string::npos);
  EXPECT_NE(differences("patches_a_stored_pressure 1\n", "patches_a_stored_pressure 2\n")
                .find("stored_pressure 2 (without effect: that of the checkpoint is kept)"),
            std::string::npos);
  EXPECT_THROW(differences("solids_a_center 1,0,0\n", "solids_a_center 2,0,0\n"), Error);
}

}  // namespace
}  // namespace fsi
