// What -describe_step says of a step, for scenes that need more or fewer of its calls.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi {
namespace {

/// Numbers of the calls that do nothing.
std::vector<int> idle(const Solver& solver) {
  std::vector<int> numbers;
  const std::vector<std::string> lines = solver.describe_step();
  EXPECT_EQ(lines.size(), 19u);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].ends_with(" nothing")) numbers.push_back(static_cast<int>(i) + 1);
  return numbers;
}

using Numbers = std::vector<int>;

class Description : public ::testing::Test {
 protected:
  Solid disc(KinematicsKind kinematics) const {
    return {.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}),
            .G = 1,
            .mu = 0.01,
            .kinematics = kinematics};
  }
  const Mesh mesh = test::box_mesh({.n = {16, 16, 0}, .periodic = {true, true, false}});
};

TEST_F(Description, WithoutSolidTheFlowIsAllThereIs) {
  Solver flow(mesh, {.mu_f = 0.01}, {});
  EXPECT_EQ(idle(flow), (Numbers{1, 2, 3, 4, 7, 8, 9, 10, 11, 12, 13, 14, 19}));
}

TEST_F(Description, EachKinematicsHasItsCalls) {
  using enum KinematicsKind;
  for (const auto& [kinematics, expected] :
       {std::pair{log_conformation, Numbers{3, 9, 10, 13, 14, 19}},
        std::pair{reference_map, Numbers{3, 4, 7, 9, 10, 13, 14, 19}},
        std::pair{left_cauchy_green, Numbers{1, 3, 4, 7, 9, 10, 12, 13, 14, 19}}}) {
    Solver one(mesh, {.mu_f = 0.01}, {});
    one.put_solid(disc(kinematics));
    EXPECT_EQ(idle(one), expected) << name_of(one.body()->kinematics);
  }
}

TEST_F(Description, MemoryViscosityDensityAndForceShow) {
  Solver one(mesh, {.mu_f = 0.01},
             {.mean_velocity = 1, .body_force = [](const Vec3&, Real) { return Vec3{}; }});
  Solid solid = disc(KinematicsKind::log_conformation);
  solid.memory = false, solid.mu = 0.1, solid.rho = 2;
  one.put_solid(solid);
  EXPECT_EQ(idle(one), (Numbers{1, 3, 7}));
  EXPECT_NE(one.describe_step()[10].find("traction between two viscosities"), std::string::npos);
}

TEST(DescriptionAtWalls, TheParabolaOfFlatWallsIsToldWithASolidAlone) {
  const Mesh mesh = test::box_mesh({.n = {16, 16, 0}});
  Conditions conditions;
  for (const Patch& patch : mesh.patches) conditions[patch.name] = Wall{};
  Solver one(mesh, {.mu_f = 0.01}, {.conditions = conditions});
  EXPECT_TRUE(one.describe_step()[8].ends_with(" nothing"));
  one.put_solid(
      {.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}), .G = 1, .mu = 0.01});
  EXPECT_NE(one.describe_step()[8].find("parabola of walls"), std::string::npos);
}

// Triangles alone make a part of convection implicit.
TEST(DescriptionOnTriangles, TheFluxIsDampedWithASolidAlone) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}, .simplex = true});
  Conditions conditions;
  for (const Patch& patch : mesh.patches) conditions[patch.name] = Wall{};
  Solver one(mesh, {.mu_f = 0.01}, {.conditions = conditions});
  EXPECT_EQ(one.describe_step()[16].find("lambda_B"), std::string::npos);
  one.put_solid(
      {.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}), .G = 1, .mu = 0.01});
  EXPECT_NE(one.describe_step()[16].find("lambda_B"), std::string::npos);
}

TEST_F(Description, SeveralSolidsAreToldApartByName) {
  Solver two(mesh, {.mu_f = 0.01}, {});
  for (const std::string name : {"left", "right"}) {
    Solid solid = disc(KinematicsKind::log_conformation);
    solid.name = name;
    solid.shape = shapes::translate(shapes::sphere(0.15), {name == "left" ? 0.25 : 0.75, 0.5, 0});
    two.put_solid(solid);
  }
  EXPECT_EQ(idle(two), (Numbers{9, 10, 13, 14, 19}));
  EXPECT_NE(two.describe_step()[1].find("left: to half a step"), std::string::npos);
  EXPECT_NE(two.describe_step()[1].find(" | right: "), std::string::npos);
}

}  // namespace
}  // namespace fsi
