// What a run tells before its first step.

#include "libfsi/run/forewords.hpp"
#include "libfsi/mesh/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/mesh/gap.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

TEST(Forewords, ThePeakOfAPulseIsFound) {
  const Mesh mesh = test::read_box({.n = {4, 4, 4}, .length = {2, 0.5, 0.5}});
  const OfTime pulse([](Real t) { return -0.1 - 0.4 * std::sin(std::numbers::pi * t); });
  const Conditions conditions{{"left", FlowRate{.rate = pulse}}, {"right", Opening{}}};
  const PeakFlow peak = peak_flow(conditions, mesh, 2);
  EXPECT_EQ(peak.patch, "left");
  EXPECT_NEAR(peak.t, 0.5, 1e-3);
  EXPECT_NEAR(peak.mean, 0.5 / 0.25, 1e-6);
  EXPECT_NEAR(peak.rate, -0.5, 1e-6) << "with its sign";
  EXPECT_NE(text_of(peak, 1).find("flow rate -0.5 (out of the mesh), Re"), std::string::npos);
  EXPECT_NEAR(peak.top, 2 * peak.mean, 1e-12) << "a parabola over a round section";
  EXPECT_NEAR(peak.length, 1 / std::sqrt(std::numbers::pi), 1e-12);
  EXPECT_EQ(peak_flow({{"left", Opening{}}, {"right", Opening{}}}, mesh, 2).patch, "");
}

TEST(Forewords, AVelocityCountsByWhatItCarries) {
  const Mesh mesh = test::read_box({.n = {4, 8, 0}});
  const auto u = [](const Vec3& x, Real t) { return Vec3{t * 4 * x.y * (1 - x.y), 0, 0}; };
  const PeakFlow peak = peak_flow({{"left", FixedVelocity{u}}}, mesh, 3);
  EXPECT_NEAR(peak.t, 3, 1e-12);
  EXPECT_NEAR(peak.mean, 2, 0.02);
  EXPECT_NEAR(peak.top, 3, 0.05);
  EXPECT_NEAR(peak.length, 1, 1e-12);
  const Conditions slit{{"left", FlowRate{.rate = 1}}, {"right", Opening{}}};
  EXPECT_NEAR(peak_flow(slit, mesh, 1).top, 1.5, 1e-12) << "a parabola between two lines";
}

// A pulse of period 1 that is 0 at all even times.
TEST(Forewords, APulseInALongRunIsSeen) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}});
  const auto pulse = [](Real t) { return std::pow(std::sin(std::acos(-1.0) * t), 2); };
  const Conditions conditions{{"left", FixedVelocity{[&](const Vec3&, Real t) {
                                 return Vec3{pulse(t), 0, 0};
                               }}},
                              {"right", FlowRate{[&](Real t) { return -0.5 * pulse(t); }}}};
  EXPECT_NEAR(peak_flow(conditions, mesh, 100).rate, 1, 1e-2);
}

TEST(Forewords, ACurvedPatchIsToldFromPlanes) {
  test::BoxFile box{.n = {12, 3, 3}};
  const Mesh flat = test::read_box(box);
  for (const Patch& patch : flat.patches) EXPECT_NEAR(curvature(patch, flat), 0, 1e-6);
  box.moved = [](const Vec3& x) {
    const Real r = 2 + x.y, angle = x.x;
    return Vec3{r * std::sin(angle), r * std::cos(angle), x.z};
  };
  const Mesh bent = test::read_box(box);
  const Real turn = 180 / std::numbers::pi / 12;
  EXPECT_NEAR(curvature(bent.patch("top"), bent), 2 * turn, turn) << "of a quad mesh of the bend";
  EXPECT_NEAR(curvature(bent.patch("back"), bent), 0, 1e-6);
}

TEST(Forewords, CellsAreCountedWhereTheSolidIs) {
  const Mesh cubes = test::read_box({.n = {10, 10, 10}});
  EXPECT_NEAR(mean_edge(shapes::sphere(0.3), cubes), 0.1, 1e-12);
  test::BoxFile box{.n = {20, 10, 10}};
  box.moved = [](const Vec3& x) { return Vec3{x.x * x.x, x.y, x.z}; };
  const Mesh fine = test::read_box(box);
  const Real at_left = mean_edge(shapes::translate(shapes::sphere(0.2), {0.2, 0.5, 0.5}), fine);
  const Real at_right = mean_edge(shapes::translate(shapes::sphere(0.2), {0.8, 0.5, 0.5}), fine);
  EXPECT_LT(at_left, at_right);
  EXPECT_NEAR(mean_edge(shapes::translate(shapes::sphere(0.1), {9, 9, 9}), cubes), 0.1, 1e-12);
}

// A sphere of the radius r whose centre is off the plane by r sin a meets it at 90 - a degrees.
TEST(Forewords, AShapeAskewAtAPlaneOfSymmetryIsFound) {
  const Mesh mesh = test::read_box({.n = {10, 10, 10}});
  const auto lean = [&](const Vec3& centre) {
    const shapes::Shape shape = shapes::translate(shapes::sphere(0.3), centre);
    std::vector<char> faces(static_cast<std::size_t>(mesh.n_boundary()), 0);
    for (const Patch& patch : mesh.patches)
      for (Index f = patch.begin; f < patch.end; ++f)
        if (patch.name == "bottom") faces[f - mesh.n_internal] = 1;
    return lean_at_planes(shape, faces, mesh);
  };
  EXPECT_LT(lean({0.52, 0, 0.49}), 1e-6);
  EXPECT_NEAR(lean({0.52, 0.15, 0.49}), 30, 0.5);
  EXPECT_NEAR(lean({0.52, -0.15, 0.49}), 30, 0.5);
  EXPECT_EQ(lean({0.52, 0.5, 0.49}), 0) << "not cut";
}

// A pipe for fsi-pipe may be periodic across, too, and off by rounding.
TEST(Forewords, APipeComesAgainAlongX) {
  const auto sentence = [](const std::vector<std::string>& periodic, Real angle) {
    test::BoxFile box{.n = {4, 4, 4}, .length = {1, 1, 1}, .periodic = periodic};
    box.moved = [=](const Vec3& x) {
      const Real c = std::cos(angle), s = std::sin(angle);
      return Vec3{c * x.x - s * x.y, s * x.x + c * x.y, x.z};
    };
    try {
      require_period_along_x(test::read_box(box));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(sentence({"left", "right"}, 0), "");
  EXPECT_EQ(sentence({"right", "left"}, 1e-5), "");
  EXPECT_EQ(sentence({"back", "front", "left", "right"}, 0), "");
  EXPECT_EQ(sentence({"left", "right"}, std::numbers::pi), "");
  const std::string across = sentence({"back", "front"}, 0);
  EXPECT_NE(across.find("along (0, 0, 1)"), std::string::npos) << across;
  const std::string aslant = sentence({"left", "right"}, std::numbers::pi / 6);
  EXPECT_NE(aslant.find("along (0.866, 0.5, 0)"), std::string::npos) << aslant;
  EXPECT_NE(aslant.find("fsi-vessel"), std::string::npos) << aslant;
  EXPECT_NE(sentence({"left", "right"}, 2e-3), "");
  EXPECT_NE(sentence({}, 0).find("no period"), std::string::npos);
}

}  // namespace
}  // namespace fsi
