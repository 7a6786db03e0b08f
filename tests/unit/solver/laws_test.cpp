// The law of the solid in the step: stress, stiffness and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/law/laws.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// The soft disc (with 3-D cells: sphere) of examples/cavity_disc.yaml.
struct Scene {
  solid::Law law{};
  Real mu_s = 0.01, G = 0.1;
  KinematicsKind kinematics = KinematicsKind::log_conformation;
};

struct Cavity {
  Cavity(const Mesh& mesh, const Scene& scene)
      : solver(mesh, {.rho = 1, .mu_f = 0.01}, {.conditions = conditions(mesh)}) {
    solver.start([](const Vec3&) { return Vec3{}; });
    const Vec3 centre{0.6, 0.6, mesh.dim == 2 ? 0.0 : 0.5};
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), centre),
                      .G = scene.G,
                      .mu = scene.mu_s,
                      .kinematics = scene.kinematics,
                      .law = scene.law});
  }
  static Conditions conditions(const Mesh& mesh) {
    Conditions walls;
    for (const Patch& patch : mesh.patches)
      walls[patch.name] = patch.name == "top" ? Wall{{1, 0, 0}} : Wall{};
    return walls;
  }
  void steps(int count, Real dt) {
    for (int i = 0; i < count; ++i) ASSERT_EQ(solver.advance(dt), dt) << solver.report().failure;
  }
  const Body& body() const { return *solver.body(); }
  Solver solver;
};

/// Collective. Largest difference of the fraction of solid, and of B where it fills a cell.
struct Apart {
  Real alpha = 0, B = 0;
};
Apart apart(const Cavity& a, const Cavity& b) {
  Apart most;
  for (Index c = 0; c < a.solver.mesh().n_owned; ++c) {
    most.alpha = std::max(most.alpha, std::abs(a.body().alpha[c] - b.body().alpha[c]));
    const SymTensor d = a.body().B_of(c) - b.body().B_of(c);
    if (a.body().alpha[c] > 0.99)
      for (const Real v : {d.xx, d.xy, d.xz, d.yy, d.yz, d.zz})
        most.B = std::max(most.B, std::abs(v));
  }
  return {global_max(most.alpha), global_max(most.B)};
}

constexpr Real dt = 0.015;

TEST(LawInStep, GentWithoutALimitIsNeoHookean) {
  const Mesh mesh = test::read_box({.n = {32, 32, 0}});
  for (const KinematicsKind kinematics :
       {KinematicsKind::log_conformation, KinematicsKind::reference_map,
        KinematicsKind::left_cauchy_green}) {
    Cavity plain(mesh, {.kinematics = kinematics});
    Cavity gent(mesh, {.law = solid::Law(solid::Gent{1e6}), .kinematics = kinematics});
    Cavity stiffening(mesh, {.law = solid::Law(solid::Gent{1}), .kinematics = kinematics});
    for (Cavity* one : {&plain, &gent, &stiffening}) one->steps(50, dt);
    const Apart same = apart(plain, gent), other = apart(plain, stiffening);
    EXPECT_LT(same.alpha, 1e-6);
    EXPECT_LT(same.B, 1e-5);
    EXPECT_GT(other.B, 3e-3);
  }
}

// In plane strain I2 = I1, and the second term of Mooney and Rivlin changes the pressure alone.
TEST(LawInStep, MooneyRivlinIsNeoHookeanInPlaneStrain) {
  const Mesh mesh = test::read_box({.n = {32, 32, 0}});
  for (const Real mu_s : {0.01, 0.002}) {
    Cavity plain(mesh, {.mu_s = mu_s});
    Cavity second(mesh, {.law = solid::Law(solid::MooneyRivlin{0.5}), .mu_s = mu_s});
    for (Cavity* one : {&plain, &second}) one->steps(50, dt);
    const Apart difference = apart(plain, second);
    EXPECT_LT(difference.alpha, 1e-3);
    EXPECT_LT(difference.B, 1e-3);
    EXPECT_GT(difference.B, 1e-9);  // it was not the same run
  }
}

TEST(LawInStep, MooneyRivlinDiffersInSpace) {
  const Mesh mesh = test::read_box({.n = {12, 12, 12}});
  const auto run = [&](Cavity& one) { one.steps(30, 2 * dt); };
  Cavity plain(mesh, {}), none(mesh, {.law = solid::Law(solid::MooneyRivlin{0})}),
      second(mesh, {.law = solid::Law(solid::MooneyRivlin{1})});
  run(plain), run(none), run(second);
  EXPECT_LT(apart(plain, none).B, 1e-9);
  EXPECT_GT(apart(plain, second).B, 1e-3);
}

TEST(LawInStep, OneOfYourOwnIsAsGoodAsAShippedOne) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}, .simplex = true});
  const solid::Law own("own", [](const solid::Jet& I1, const solid::Jet& /*I2*/) {
    return log(1 - (I1 - 3) / 2) * -1;  // Gent's with J_m = 2
  });
  Cavity shipped(mesh, {.law = solid::Law(solid::Gent{2})}), given(mesh, {.law = own});
  for (Cavity* one : {&shipped, &given}) one->steps(20, 2 * dt);
  EXPECT_LT(apart(shipped, given).B, 1e-9);
  EXPECT_NEAR(given.body().law.energy(0.1, given.body().B, given.body().alpha, mesh),
              shipped.body().law.energy(0.1, shipped.body().B, shipped.body().alpha, mesh), 1e-12);
}

// What limits the step follows the law: the fastest wave of a uniform stretch, by hand.
TEST(LawInStep, StiffnessFollows) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}});
  const SymTensor B{2, 0, 0, 0.5, 0, 1};
  const auto elastic_dt = [&](const solid::Law& law) {
    Cavity one(mesh, {.law = law});
    one.solver.body()->set_B([&](const Vec3&) { return B; });
    return one.solver.elastic_dt();
  };
  const auto expected = [](Real modulus) { return 1.5 / 16 * std::sqrt(1 / (0.1 * modulus)); };
  EXPECT_NEAR(elastic_dt({}), expected(2), 1e-12);
  EXPECT_NEAR(elastic_dt(solid::Law(solid::MooneyRivlin{0.5})), expected(2), 1e-12);
  // Gent: 2 W_1 = J / (J - I1 + 3) = 2, 4 W_11 = 2 J / (J - I1 + 3)^2 = 8, (b_3 - b_1)^2 = 2.25;
  // at x = sin^2 of the angle to the longer axis (1 - x) 4 + x 1 + 18 x (1 - x)
  const Real x = (1 - 3.0 / 18) / 2;
  EXPECT_NEAR(elastic_dt(solid::Law(solid::Gent{1})), expected((1 - x) * 4 + x + 18 * x * (1 - x)),
              1e-12);
}

// The pressure that goes on with the surface is that of the law: twice neo-Hookean's here.
TEST(LawInStep, JumpOfThePressureFollows) {
  const Mesh mesh = test::read_box({.n = {24, 24, 0}});
  const auto carried = [&](const solid::Law& law) {
    Cavity one(mesh, {.law = law});
    one.solver.start([](const Vec3& x) { return Vec3{x.y - 0.5, 0.5 - x.x, 0}; });
    one.solver.body()->set_B([](const Vec3&) { return SymTensor{2, 0, 0, 0.5, 0, 1}; });
    one.solver.body()->t = -0.05;
    one.solver.synchronise();
    const auto p = one.solver.state().p.owned();
    return std::vector<Real>(p.begin(), p.end());
  };
  const std::vector<Real> plain = carried({}), gent = carried(solid::Law(solid::Gent{1}));
  Real largest = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(gent[i], 2 * plain[i], 1e-12);
    largest = std::max(largest, std::abs(plain[i]));
  }
  EXPECT_GT(global_max(largest), 1e-3);
}

// A slab at rest, sheared by g, under a fluid that slides over it with the slab's own traction: the
// law, the traction at the surface and the pressure's jump leave all at rest.
TEST(LawInStep, ShearedSlabBearsTheFlowAboveIt) {
  const Mesh mesh =
      test::read_box({.n = {8, 20, 0}, .length = {0.8, 2, 1}, .periodic = {"left", "right"}});
  constexpr Real g = 0.6, y_0 = 1;
  const SymTensor B{1 + g * g, g, 0, 1, 0, 1};
  for (const solid::Law& law :
       {solid::Law(), solid::Law(solid::Gent{1}), solid::Law(solid::MooneyRivlin{0.7})})
    for (const Real mu_s : {1.0, 5.0, 0.3}) {
      const SymTensor T = dev(law.at(B).T);
      const Real G = 1 / T.xy;  // traction 1, mu_f = 1
      Solver solver(mesh, {.rho = 1, .mu_f = 1},
                    {.conditions = {{"top", Wall{{2 - y_0, 0, 0}}}, {"bottom", Wall{}}}});
      const auto u = [&](const Vec3& x) { return Vec3{std::max(x.y - y_0, 0.0), 0, 0}; };
      solver.start(u);
      solver.put_solid({.shape = shapes::translate(shapes::box({40, y_0, 40}), {0, y_0 / 2, 0}),
                        .G = G,
                        .mu = mu_s,
                        .law = law});
      solver.body()->set_B([&](const Vec3&) { return B; });
      CellField<Real>& p = solver.state().p;
      for (Index c = 0; c < mesh.n_cells; ++c) p[c] = G * T.yy * solver.body()->alpha[c];
      for (int i = 0; i < 3; ++i) solver.step(0.02);
      Real worst = 0;
      for (Index c = 0; c < mesh.n_owned; ++c)
        worst = std::max(worst, norm(solver.state().u[c] - u(mesh.C[c])));
      EXPECT_LT(global_max(worst), 1e-6) << law.name() << ", mu_s " << mu_s;
    }
}

TEST(LawInStep, StrainBeyondItTakesTheStepBack) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}});
  Cavity one(mesh, {.law = solid::Law(solid::Gent{1e-6})});
  int steps = 0;
  while (steps < 200 && one.solver.advance(dt) > 0) ++steps;
  const StepReport& report = one.solver.report();
  EXPECT_LT(steps, 200);
  EXPECT_TRUE(report.rejections.contains("the solid is strained beyond its law, gent"));
  EXPECT_NE(report.failure.find("the solid is strained beyond its law, gent; the largest tr B - 3"),
            std::string::npos)
      << report.failure;
  EXPECT_FALSE(one.body().beyond_law);  // the state is that before the step
}

}  // namespace
}  // namespace fsi
