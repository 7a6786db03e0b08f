// What fsi-mesh check tells of patches and of the solver's treatment, on meshes where it is known.

#include "libfsi/run/doctor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfsi/mesh/figures.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

TEST(Patches, OfABox) {
  const Mesh mesh = test::read_box({.n = {4, 3, 2}, .length = {2, 3, 4}});
  const PatchFigures right = patch_figures(mesh, mesh.patch("right"));
  EXPECT_EQ(right.faces, 6);
  EXPECT_NEAR(right.area, 12, 1e-12);
  EXPECT_EQ(right.normal, (Vec3{1, 0, 0}));
  EXPECT_NEAR(right.diameter, std::sqrt(48 / 3.14159265358979), 1e-12);
  EXPECT_NEAR(norm(right.centre - Vec3{2, 1.5, 2}), 0, 1e-12);
  EXPECT_TRUE(right.flat);
  const Mesh plane = test::read_box({.n = {4, 3, 0}, .length = {2, 3, 1}});
  EXPECT_NEAR(patch_figures(plane, plane.patch("left")).diameter, 3, 1e-12);
}

TEST(Patches, ThatAreBentOrOffset) {
  const Mesh bent = test::read_box({.n = {4, 4, 4}, .moved = [](const Vec3& x) {
                                      return Vec3{x.x + 0.1 * x.y * (1 - x.y), x.y, x.z};
                                    }});
  const PatchFigures right = patch_figures(bent, bent.patch("right"));
  EXPECT_FALSE(right.flat);
  // The outermost of four chords of the parabola rises by 0.1 * 3/16 over 1/4.
  EXPECT_NEAR(right.degrees, std::atan(0.075) * 180 / 3.14159265358979, 1e-9);
  EXPECT_TRUE(patch_figures(bent, bent.patch("top")).flat);
}

TEST(Treatment, OfEvenAndShearedCells) {
  const Mesh even = test::read_box({.n = {8, 8, 0}});
  const Treatment none = treatment(even, FaceWeights(even));
  EXPECT_EQ(none.n_internal, 112);
  EXPECT_EQ(none.n_irregular, 0);
  EXPECT_NEAR(none.beta_mean, 0, 1e-12);
  EXPECT_NEAR(none.theta_mean, 0.5, 1e-12);
  EXPECT_NEAR(worst(none.rate, even, 1).front().value, 8, 1e-12);
  const Mesh sheared = test::read_box({.n = {8, 8, 0}, .moved = [](const Vec3& x) {
                                         return Vec3{x.x + 0.5 * x.y, x.y, 0};
                                       }});
  const Treatment some = treatment(sheared, FaceWeights(sheared));
  EXPECT_EQ(some.n_irregular, 112);
  EXPECT_NEAR(some.theta_mean, (1 + 0.5) / 2, 1e-12) << "the tangent of the angle is 1/2";
  EXPECT_NEAR(worst(some.beta, sheared, 1).front().value, 0, 1e-12);
}

TEST(Treatment, DampsWhereTheFaceIsNotMidway) {
  // Two squares of sides 1 and 2 a third and two thirds of the way: m = d / 6.
  const Mesh mesh = test::read_box({.n = {2, 1, 0}, .moved = [](const Vec3& x) {
                                      return Vec3{x.x < 0.6 ? 2 * x.x : 3, x.y, 0};
                                    }});
  EXPECT_NEAR(treatment(mesh, FaceWeights(mesh)).beta_mean, 1.0 / 24, 1e-12);
}

TEST(Findings, NameFigureLimitPlaceAndRemedy) {
  MeshFigures figures;
  figures.gap = {.cells = 20, .width = 1, .from = "wall", .to = "wall"};
  EXPECT_TRUE(findings(figures).empty());
  EXPECT_EQ(warning("a.msh", findings(figures)), "");
  figures.quality.aspect_ratio = {40, {1, 2, 3}, 7, CellType::tet};
  figures.gap.cells = 6 * (1 - 1e-12);  // six, but for rounding
  EXPECT_EQ(findings(figures).size(), 1u);
  figures.gap.cells = 2.5;
  const std::vector<Finding> found = findings(figures);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].what, "aspect ratio 40 (limit 25) in a tet at (1, 2, 3)");
  EXPECT_NE(found[0].change.find("Mesh.Optimize = 1"), std::string::npos);
  EXPECT_EQ(found[1].what.find("2.5 cells (at least 6 wanted) across a passage of width 1"), 0u);
  EXPECT_NE(found[1].change.find("VIn = 0.083"), std::string::npos);
  EXPECT_EQ(warning("a.msh", found).find("mesh a.msh: aspect ratio 40"), 0u);
}

TEST(Findings, OfAShearedBoxAreThoseOfItsFaces) {
  const Mesh mesh = test::read_box({.n = {8, 8, 0}, .moved = [](const Vec3& x) {
                                      return Vec3{x.x + 4 * x.y, x.y, 0};
                                    }});
  const std::vector<Finding> found = findings(mesh_figures(mesh, {"bottom", "top"}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].what.find("non-orthogonality 76 deg (limit 75) in a quad at ("), 0u)
      << found[0].what;
  EXPECT_NE(found[0].change.find("Transfinite"), std::string::npos);
}

}  // namespace
}  // namespace fsi
