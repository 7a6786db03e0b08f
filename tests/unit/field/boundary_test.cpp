// What each condition sets on the boundary faces.

#include "libfsi/field/boundary.hpp"

#include <gtest/gtest.h>

#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// Largest difference from `exact` on the faces of a patch.
template <class Exact>
Real error(const BoundaryField<Vec3>& u_b, const std::string& patch, const Mesh& mesh,
           const Exact& exact) {
  Real worst = 0;
  for (const Patch& p : mesh.patches)
    for (Index f = p.begin; p.name == patch && f < p.end; ++f)
      worst = std::max(worst, norm(u_b[f - mesh.n_internal] - exact(mesh.Cf[f])));
  return global_max(worst);
}

TEST(Boundary, EachConditionSetsItsVelocity) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}});
  const Vec3 inside{0.3, 0.2, 0};
  const auto conditions = resolve({{"top", Wall{{1, 0, 0}}},
                                   {"bottom", Slip{}},
                                   {"left", FixedVelocity{[](const Vec3& x, Real t) {
                                      return Vec3{t * x.y, 0, 0};
                                    }}},
                                   {"right", Opening{}}},
                                  mesh);
  BoundaryField<Vec3> u_b(mesh);
  set_boundary_velocity(u_b, CellField<Vec3>(mesh, inside), conditions, 2, mesh);
  EXPECT_EQ(error(u_b, "top", mesh, [](const Vec3&) { return Vec3{1, 0, 0}; }), 0);
  EXPECT_LT(error(u_b, "bottom", mesh, [](const Vec3&) { return Vec3{0.3, 0, 0}; }), 1e-16);
  EXPECT_LT(error(u_b, "left", mesh, [](const Vec3& x) { return Vec3{2 * x.y, 0, 0}; }), 1e-15);
  EXPECT_EQ(error(u_b, "right", mesh, [&](const Vec3&) { return inside; }), 0);
}

TEST(Boundary, AFlowRateIsSpreadOverThePatch) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}, .length = {1, 2, 0}});
  const auto conditions =
      resolve({{"left", FlowRate{OfTime([](Real t) { return 3 * t; }), InflowProfile::plug}},
               {"right", Opening{}},
               {"top", Wall{}},
               {"bottom", Wall{}}},
              mesh);
  BoundaryField<Vec3> u_b(mesh);
  set_boundary_velocity(u_b, CellField<Vec3>(mesh), conditions, 2, mesh);
  EXPECT_LT(error(u_b, "left", mesh, [](const Vec3&) { return Vec3{3, 0, 0}; }), 1e-14);
}

TEST(Boundary, KindsOfConditions) {
  EXPECT_TRUE(fixes_velocity(Wall{}) && !prescribes_flow(Wall{}) && !fixes_pressure(Wall{}));
  EXPECT_TRUE(fixes_velocity(FlowRate{}) && prescribes_flow(FlowRate{}));
  EXPECT_TRUE(fixes_velocity(FixedVelocity{}) && prescribes_flow(FixedVelocity{}));
  EXPECT_TRUE(fixes_pressure(Opening{}) && !fixes_velocity(Opening{}));
  EXPECT_FALSE(fixes_velocity(Slip{}) || prescribes_flow(Slip{}) || fixes_pressure(Slip{}));
}

}  // namespace
}  // namespace fsi
