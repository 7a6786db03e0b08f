// Half of a symmetric scene, with a plane of symmetry, against the whole: a channel along x between
// walls at y = 0 and 1, periodic, and its lower half.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

constexpr Index n = 16;  // cells across
constexpr Real mu = 0.05, dt = 0.005;
constexpr int steps = 20;

Mesh channel(Index across, bool open = false) {
  return test::read_box(
      {.n = {2 * n, across, 0},
       .length = {2, static_cast<Real>(across) / n, 1},
       .periodic = open ? std::vector<std::string>{} : std::vector<std::string>{"left", "right"}});
}

Conditions conditions(const Condition& top, bool open) {
  Conditions all{{"bottom", Wall{}}, {"top", top}};
  if (open) {
    all.emplace("left", FixedVelocity{[](const Vec3&, Real) { return Vec3{1, 0, 0}; }});
    all.emplace("right", Opening{});
  }
  return all;
}

/// A plug that the walls slow down, so that u_y is not 0.
Vec3 start(const Vec3& x) {
  return {1 + 0.2 * std::sin(std::numbers::pi * x.x) * std::cos(2 * std::numbers::pi * x.y),
          0.1 * std::sin(2 * std::numbers::pi * x.y), 0};
}

struct Pair {
  Pair(const Mesh& whole, const Mesh& half, bool open = false)
      : of_whole(whole, {.rho = 1, .mu_f = mu}, {.conditions = conditions(Wall{}, open)}),
        of_half(half, {.rho = 1, .mu_f = mu}, {.conditions = conditions(Slip{}, open)}) {
    of_whole.start(start), of_half.start(start);
    std::map<std::pair<long, long>, Index> at;
    const auto place = [](const Vec3& x) {
      return std::pair{std::lround(1e6 * x.x), std::lround(1e6 * x.y)};
    };
    for (Index c = 0; c < whole.n_cells; ++c) at[place(whole.C[c])] = c;
    for (Index c = 0; c < half.n_owned; ++c) twin.push_back(at.at(place(half.C[c])));
  }
  void run() {
    for (int i = 0; i < steps; ++i) of_whole.step(dt), of_half.step(dt);
  }
  /// The largest difference of the velocities.
  Real apart() const {
    Real most = 0;
    for (std::size_t c = 0; c < twin.size(); ++c)
      most = std::max(most,
                      norm(of_whole.state().u[twin[c]] - of_half.state().u[static_cast<Index>(c)]));
    return global_max(most);
  }
  Solver of_whole, of_half;
  std::vector<Index> twin;  // cells of the whole
};

/// The largest difference of alpha.
Real alpha_apart(const Pair& pair) {
  Real most = 0;
  for (std::size_t c = 0; c < pair.twin.size(); ++c)
    most = std::max(most, std::abs(pair.of_whole.body()->alpha[pair.twin[c]] -
                                   pair.of_half.body()->alpha[static_cast<Index>(c)]));
  return global_max(most);
}

TEST(Half, OfAFlowIsThatOfTheWhole) {
  const Mesh whole = channel(n), half = channel(n / 2);
  Pair pair(whole, half);
  pair.run();
  EXPECT_LT(pair.apart(), 1e-8);
}

// The Taylor-Green vortex between four planes. With a pressure that is continued linearly to the
// planes, u was off by 6.8e-4 on 32 quads, and u_y in the row at a plane by 1.9e-3.
TEST(Half, AVortexBetweenPlanesIsExactAtThePlanesToo) {
  constexpr Real pi = std::numbers::pi, viscosity = 0.01, end = 0.5;
  std::array<Real, 2> errors{};
  for (const Index cells : {16, 32}) {
    const Mesh mesh = test::read_box({.n = {cells, cells, 0}, .length = {1, 1, 1}});
    Solver solver(
        mesh, {.rho = 1, .mu_f = viscosity},
        {.conditions = {{"bottom", Slip{}}, {"top", Slip{}}, {"left", Slip{}}, {"right", Slip{}}}});
    const auto u = [](const Vec3& x) {
      return Vec3{std::sin(pi * x.x) * std::cos(pi * x.y), -std::cos(pi * x.x) * std::sin(pi * x.y),
                  0};
    };
    solver.start(u);
    for (Index i = 0; i < 2 * cells; ++i) solver.step(end / (2.0 * cells));
    const Real decay = std::exp(-2 * pi * pi * viscosity * end);
    Sum square, of_row, row;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const Vec3 off = solver.state().u[c] - decay * u(mesh.C[c]);
      square.add(mesh.V[c] * norm2(off));
      if (mesh.C[c].y < 1.0 / cells) of_row.add(off.y * off.y), row.add(1);
    }
    errors[cells / 32] = std::sqrt(square.total());
    const Real at_plane = std::sqrt(of_row.total() / row.total());
    std::printf("%d cells a side: u %.2e, u_y at the plane %.2e\n", cells, errors[cells / 32],
                at_plane);
    EXPECT_LT(at_plane, errors[cells / 32]);
  }
  EXPECT_LT(errors[1], 1.3e-4);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
}

/// A disc with this part of the fluid's viscosity.
void compare_solid(Real ratio, bool memory, Real bound) {
  const Mesh whole = channel(n), half = channel(n / 2);
  Pair pair(whole, half);
  for (Solver* solver : {&pair.of_whole, &pair.of_half})
    solver->put_solid({.shape = shapes::translate(shapes::sphere(0.29), {0.6, 0.5, 0}),
                       .G = 1,
                       .mu = ratio * mu,
                       .memory = memory});
  pair.run();
  const Body &of_whole = *pair.of_whole.body(), &of_half = *pair.of_half.body();
  Real B = 0;
  for (std::size_t c = 0; c < pair.twin.size(); ++c) {
    const Index h = static_cast<Index>(c), w = pair.twin[c];
    B = std::max(B, std::abs(of_whole.B[w].xx - of_half.B[h].xx) +
                        std::abs(of_whole.B[w].xy - of_half.B[h].xy));
  }
  std::printf("viscosity %g, memory %d: u %.1e, alpha %.1e, B %.1e\n", ratio, memory, pair.apart(),
              alpha_apart(pair), global_max(B));
  EXPECT_LT(pair.apart(), bound);
  EXPECT_LT(alpha_apart(pair), bound);
  EXPECT_LT(global_max(B), 10 * bound);
}

TEST(Half, OfASolidIsThatOfTheWhole) {
  for (const bool memory : {true, false}) compare_solid(1, memory, 1e-4);
}

// The stress of a surface between two viscosities has images beyond the plane, too.
TEST(Half, OfASolidOfAnotherViscosityIsThatOfTheWhole) {
  compare_solid(10, true, 1e-4);
  compare_solid(0.1, true, 2e-4);
  compare_solid(150, true, 1e-4);
}

// The rule for a solid that an opening has cut must not act on what goes through a plane of
// symmetry by rounding.
TEST(Half, OfASolidNearAnOutletIsThatOfTheWhole) {
  const Mesh whole = channel(n, true), half = channel(n / 2, true);
  Pair pair(whole, half, true);
  for (Solver* solver : {&pair.of_whole, &pair.of_half})
    solver->put_solid({.shape = shapes::translate(shapes::sphere(0.29), {1.5, 0.5, 0}),
                       .G = 1,
                       .mu = mu,
                       .memory = true});
  pair.of_half.bodies().front().volume_out = 1e-20;
  pair.run();
  std::printf("near an outlet: alpha %.1e\n", alpha_apart(pair));
  EXPECT_LT(alpha_apart(pair), 1e-4);
}

}  // namespace
}  // namespace fsi
