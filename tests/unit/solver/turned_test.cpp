// A scene that is turned, mirrored, or given in other units or with its cells in another order has
// the same flow and strain.

#include <gtest/gtest.h>
#include <petscsys.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "libfsi/shapes/shapes.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// While this lives, solvers that are made solve to round-off.
struct Exactly {
  Exactly() {
    PetscOptionsSetValue(nullptr, "-u_ksp_rtol", "1e-14");
    PetscOptionsSetValue(nullptr, "-p_ksp_rtol", "1e-12");
  }
  Exactly(const Exactly&) = delete;
  Exactly& operator=(const Exactly&) = delete;
  ~Exactly() {
    PetscOptionsClearValue(nullptr, "-u_ksp_rtol");
    PetscOptionsClearValue(nullptr, "-p_ksp_rtol");
  }
};

/// How a scene is given: the mirror image in the plane x = y, then a turn by an angle about z, in
/// three dimensions then by the same about x, and units.
struct Given {
  const char* name;
  Real degrees = 0;
  bool mirrored = false;
  bool shuffled = false;  ///< cells and nodes in another order
  Real length = 1, velocity = 1, density = 1;

  Vec3 operator()(const Vec3& x, int dim) const {
    const Vec3 m = mirrored ? Vec3{x.y, x.x, x.z} : x;
    const Vec3 y{c() * m.x - s() * m.y, s() * m.x + c() * m.y, m.z};
    return dim == 2 ? y : Vec3{y.x, c() * y.y - s() * y.z, s() * y.y + c() * y.z};
  }
  Vec3 back(const Vec3& x, int dim) const {
    const Vec3 y = dim == 2 ? x : Vec3{x.x, c() * x.y + s() * x.z, c() * x.z - s() * x.y};
    const Vec3 m{c() * y.x + s() * y.y, c() * y.y - s() * y.x, y.z};
    return mirrored ? Vec3{m.y, m.x, m.z} : m;
  }
  Real c() const { return std::cos(degrees * std::numbers::pi / 180); }
  Real s() const { return std::sin(degrees * std::numbers::pi / 180); }
};

/// Soft discs or spheres under a lid that moves, on cells that are bent.
struct Scene {
  const char* name;
  KinematicsKind kinematics = KinematicsKind::log_conformation;
  flow::Convection convection = flow::Convection::linear;
  std::array<Index, 3> n{20, 20, 0};
  Real mu_s = 0.02;
  Real rho_s = 1;
  std::vector<Vec3> centres{{0.55, 0.6, 0}};
  Real radius = 0.23;
  bool planes = false;  ///< of symmetry
  bool memory = true;
  int steps = 40;
  Real tolerance = 1e-8;
};

struct Result {
  std::vector<Vec3> u;
  std::vector<Real> I1;
};

Conditions conditions_of(const Scene& scene, const Given& given, int dim) {
  const Vec3 lid = given.velocity * given({1, 0, dim == 3 ? 0.3 : 0}, dim);
  Conditions all{{"left", Wall{}}, {"right", Wall{}}, {"top", Wall{lid}}, {"bottom", Wall{}}};
  if (dim == 3) all["back"] = all["front"] = Wall{};
  if (scene.planes) all["right"] = Slip{};
  if (scene.planes && dim == 3) all["front"] = Slip{};
  return all;
}

/// The cells by their places in the plain scene.
std::vector<Index> ordered(const Mesh& mesh, const Given& given, int dim) {
  std::vector<Index> cells(static_cast<std::size_t>(mesh.n_owned));
  std::iota(cells.begin(), cells.end(), 0);
  const auto key = [&](Index c) {
    const Vec3 x = given.back(mesh.C[c], dim) / given.length;
    const auto rounded = [](Real v) { return std::lround(1e5 * v); };
    return std::array{rounded(x.x), rounded(x.y), rounded(x.z)};
  };
  std::ranges::sort(cells, {}, key);
  return cells;
}

Result run(const Scene& scene, bool simplex, const Given& given) {
  const int dim = scene.n[2] > 0 ? 3 : 2;
  const auto [L, U, rho] = std::array{given.length, given.velocity, given.density};
  const auto moved = [&, length = L](const Vec3& x) {
    const Real s = std::sin(std::numbers::pi * x.x) * std::sin(2 * std::numbers::pi * x.y);
    return length * given({x.x + 0.03 * s, x.y - 0.02 * s, x.z}, dim);
  };
  const Mesh mesh = test::read_box(
      {.n = scene.n, .simplex = simplex, .moved = moved, .shuffled = given.shuffled});
  Solver solver(mesh, {.rho = rho, .mu_f = 0.02 * rho * U * L},
                {.conditions = conditions_of(scene, given, dim), .convection = scene.convection});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (const Vec3& x : scene.centres)
    solver.put_solid(
        {.shape = shapes::translate(shapes::sphere(L * scene.radius), L * given(x, dim)),
         .G = 0.5 * rho * U * U,
         .mu = scene.mu_s * rho * U * L,
         .name = "at_" + std::to_string(solver.bodies().size()),
         .kinematics = scene.kinematics,
         .rho = scene.rho_s * rho,
         .memory = scene.memory});
  for (int i = 0; i < scene.steps; ++i) solver.step(0.02 * L / U);
  Result result;
  const std::vector<Index> order = ordered(mesh, given, dim);
  for (const Index c : order) result.u.push_back(given.back(solver.state().u[c], dim) / U);
  for (const Body& body : solver.bodies())
    for (const Index c : order) result.I1.push_back(body.alpha[c] > 0.5 ? trace(body.B[c]) : 3);
  return result;
}

std::vector<Scene> scenes() {
  using enum KinematicsKind;
  // To what accuracy a sphere fills cells depends on the order of a cell's nodes.
  constexpr Real in_space = 1e-6;
  // On triangles the limiter switches on and off where the flow hardly changes.
  constexpr Real switching = 1e-5;
  // Its inertia is taken along the axes.
  constexpr Real heavy = 2e-3;
  // A face between cells of equal stress has the whole step as its time t_f, and one with a
  // difference of 1e-7 of it next to nothing. Rounding there is magnified for a step.
  constexpr Real of_t_f = 2e-7;
  return {{.name = "log_conformation", .tolerance = of_t_f},
          {.name = "without memory", .memory = false},
          {.name = "limited convection",
           .convection = flow::Convection::limited,
           .tolerance = switching},
          {.name = "reference_map", .kinematics = reference_map},
          {.name = "left_cauchy_green", .kinematics = left_cauchy_green},
          {.name = "viscous solid", .mu_s = 0.1},
          {.name = "viscous fluid", .mu_s = 0.005},
          {.name = "heavy solid", .rho_s = 2, .tolerance = heavy},
          {.name = "near the lid", .centres = {{0.55, 0.75, 0}}, .steps = 80},
          {.name = "two", .centres = {{0.3, 0.6, 0}, {0.72, 0.6, 0}}, .radius = 0.19},
          {.name = "plane of symmetry", .centres = {{0.7, 0.6, 0}}, .planes = true},
          {.name = "sphere",
           .n = {10, 10, 10},
           .mu_s = 0.1,
           .centres = {{0.5, 0.6, 0.5}},
           .radius = 0.3,
           .planes = true,
           .steps = 15,
           .tolerance = in_space}};
}

TEST(Turned, ScenesHaveTheSameResults) {
  const Exactly exactly;
  for (const Scene& scene : scenes())
    for (const bool simplex : {false, true}) {
      const Result plain = run(scene, simplex, {.name = "plain"});
      const Real strain = *std::ranges::max_element(plain.I1) - 3;
      EXPECT_GT(strain, 1e-3);
      for (const Given& given :
           {Given{.name = "turned", .degrees = 37}, Given{.name = "mirrored", .mirrored = true},
            Given{.name = "in another order", .shuffled = true},
            Given{.name = "other units", .length = 1.7e-6, .velocity = 3.1e-3, .density = 1047}}) {
        const Result other = run(scene, simplex, given);
        Real u = 0, I1 = 0;
        for (std::size_t c = 0; c < plain.u.size(); ++c)
          u = std::max(u, norm(other.u[c] - plain.u[c]));
        for (std::size_t c = 0; c < plain.I1.size(); ++c)
          I1 = std::max(I1, std::abs(other.I1[c] - plain.I1[c]));
        std::printf("%s, %s, %s: u %.1e, tr B %.1e of %.2f\n", scene.name,
                    simplex ? "simplices" : "boxes", given.name, u, I1, strain);
        EXPECT_LT(u, scene.tolerance);
        EXPECT_LT(I1, scene.tolerance);
      }
    }
}

}  // namespace
}  // namespace fsi
