// Profiles at openings do not depend on directions, on corners or on the part of the scene that is
// meshed.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// x at the middle of a cell of a unit of 1e-9, to look for its image.
std::tuple<long, long, long> key(const Vec3& x) {
  const auto whole = [](Real a) { return std::lround(a * 1e9); };
  return {whole(x.x), whole(x.y), whole(x.z)};
}

/// Largest difference of the velocities at mirror images, over the largest velocity, after a few
/// steps in a square duct. mirror: exchanges y and z, or turns y round.
template <class Mirror>
Real asymmetry(Index n, const Condition& inlet, const Mirror& mirror) {
  const Mesh mesh = test::read_box({.n = {4, n, n}});
  Conditions conditions{{"left", inlet}, {"right", Opening{0}}};
  for (const char* wall : {"bottom", "top", "back", "front"}) conditions[wall] = Wall{};
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01}, {.conditions = conditions});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (int i = 0; i < 20; ++i) solver.step(0.02);
  std::map<std::tuple<long, long, long>, Vec3> u;
  Real largest = 0, most = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    u[key(mesh.C[c])] = solver.state().u[c];
    largest = std::max(largest, norm(solver.state().u[c]));
  }
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const auto image = u.find(key(mirror(mesh.C[c], Vec3{0, 1, 1})));
    if (image == u.end()) continue;  // of another rank
    most = std::max(most, norm(mirror(solver.state().u[c], Vec3{}) - image->second));
  }
  return most / largest;
}

// 49 faces are too few for all terms of fourth degree.
TEST(OpeningProfiles, AreTheSameAlongAllDirections) {
  const auto exchange = [](const Vec3& a, const Vec3&) { return Vec3{a.x, a.z, a.y}; };
  EXPECT_LT(asymmetry(7, Opening{1}, exchange), 1e-4);
}

TEST(OpeningProfiles, DoNotDependOnTheFirstCornerOfAFace) {
  const auto turn = [](const Vec3& a, const Vec3& width) { return Vec3{a.x, width.y - a.y, a.z}; };
  EXPECT_LT(asymmetry(6, FlowRate{[](Real) { return 1.0; }}, turn), 1e-4);
}

/// Flow rate at t = 2 in a channel of height 1 from one pressure to another, or in half of it.
Real flow_rate(Index n, bool half) {
  const Mesh mesh =
      test::read_box({.n = {2 * n, half ? n / 2 : n, 0}, .length = {2, half ? 0.5 : 1.0, 1}});
  Conditions conditions{{"left", Opening{1}}, {"right", Opening{0}}, {"bottom", Wall{}}};
  conditions["top"] = half ? Condition(Slip{}) : Condition(Wall{});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01}, {.conditions = conditions});
  solver.start([](const Vec3&) { return Vec3{}; });
  while (solver.state().t < 2) solver.step(0.01);
  const Patch& inlet = mesh.patch("left");
  Sum flow;
  for (Index f = inlet.begin; f < inlet.end; ++f) flow.add(-solver.state().phi[f]);
  return (half ? 2 : 1) * flow.total();
}

// Across a plane of symmetry the profile is even.
TEST(OpeningProfiles, OfHalfASceneAreThoseOfTheWhole) {
  EXPECT_NEAR(flow_rate(16, true) / flow_rate(16, false), 1, 2e-4);
}

}  // namespace
}  // namespace fsi
