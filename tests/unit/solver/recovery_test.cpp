// Steps that are taken back: the state after the recovered step is that of a solver which took the
// smaller step at once, bit for bit, and where no step is small enough the state is the last good
// one.

#include <gtest/gtest.h>
#include <petscsys.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// A disc in a cavity whose lid slides.
struct Scene {
  bool simplex = false;
  KinematicsKind kinematics = KinematicsKind::log_conformation;
  Real G = 1, mu_s = 0.01;
  Condition lid = Wall{{1, 0, 0}};
};

constexpr Index n = 16;

Mesh mesh_of(const Scene& scene) {
  return test::read_box({.n = {n, n, 0}, .simplex = scene.simplex});
}

struct Trial {
  Trial(const Mesh& mesh, const Scene& scene)
      : solver(mesh, {.rho = 1, .mu_f = 0.01},
               {.conditions = {
                    {"top", scene.lid}, {"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}}}) {
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.6, 0.55, 0}),
                      .G = scene.G,
                      .mu = scene.mu_s,
                      .kinematics = scene.kinematics});
  }
  void steps(int count, Real dt) {
    for (int i = 0; i < count; ++i) ASSERT_EQ(solver.advance(dt), dt);
  }
  /// All that a checkpoint would hold, halo included, but for the limit on the steps to come.
  std::vector<Real> state() {
    const Mesh& mesh = solver.mesh();
    io::Snapshot all;
    solver.list(all);
    std::vector<Real> values;
    for (const auto& f : all.fields()) {
      const Index items = f.on == Location::cells ? mesh.n_cells : mesh.n_faces;
      values.insert(values.end(), f.values,
                    f.values + static_cast<std::ptrdiff_t>(items) * f.width);
    }
    for (const auto& [name, scalar] : all.scalars()) {
      if (name == "dt_cap") continue;
      if (const auto* real = std::get_if<Real*>(&scalar)) values.push_back(**real);
      if (const auto* whole = std::get_if<std::int64_t*>(&scalar))
        values.push_back(static_cast<Real>(**whole));
    }
    return values;
  }
  std::int64_t rejections() const {
    std::int64_t sum = 0;
    for (const auto& [reason, number] : solver.report().rejections) sum += number;
    return sum;
  }
  Solver solver;
};

/// A step of four times the Courant limit after some good ones, and three more while dt grows
/// again.
void expect_recovery(const Scene& scene, int good_steps) {
  const Mesh mesh = mesh_of(scene);
  Trial one(mesh, scene), other(mesh, scene);
  one.steps(good_steps, 0.02), other.steps(good_steps, 0.02);
  const Real limit = std::min(one.solver.advective_dt(1.2), one.solver.boundary_dt(1.2));
  const Real asked = 8 * 0.52 * limit;
  const StepReport& report = one.solver.report();
  Real expected = asked;
  for (int i = 0; i < 4; ++i) {
    const std::int64_t before = report.rejected;
    const Real dt = one.solver.advance(asked);
    ASSERT_GT(dt, 0) << report.failure;
    if (i == 0) {
      EXPECT_GE(report.rejected, 1);
    }
    EXPECT_EQ(dt, std::ldexp(expected, static_cast<int>(before - report.rejected)));
    EXPECT_TRUE(report.held_back);
    ASSERT_EQ(other.solver.advance(dt), dt);
    EXPECT_TRUE(one.state() == other.state())
        << "step " << i << " after " << good_steps << " good ones";
    expected = 1.1 * dt;
  }
  EXPECT_EQ(report.rejected, one.rejections());
  EXPECT_TRUE(report.rejections.contains("the flow became too fast for the step") ||
              report.rejections.contains("the solid became too stiff for the step"));
  EXPECT_EQ(report.failure, "");
  EXPECT_EQ(other.solver.report().rejected, 0);
  EXPECT_FALSE(other.solver.report().held_back);
  // What lies below the limit on growth is not held back.
  EXPECT_EQ(one.solver.advance(expected / 2), expected / 2);
  EXPECT_FALSE(report.held_back);
}

TEST(Recovery, IsTheSmallerStepOnQuads) {
  for (const int good : {0, 1, 2, 3, 6, 7}) expect_recovery({}, good);
}

TEST(Recovery, AStepOfNoLengthIsRefused) {
  const Mesh mesh = mesh_of({});
  Trial one(mesh, {}), other(mesh, {});
  one.steps(3, 0.02), other.steps(3, 0.02);
  constexpr Real none = std::numeric_limits<Real>::quiet_NaN();
  for (const Real dt : {0.0, -0.0, -0.02, none, std::numeric_limits<Real>::infinity()})
    for (const bool whole : {true, false}) {
      try {
        if (whole)
          one.solver.advance(dt);
        else
          one.solver.step(dt);
        ADD_FAILURE() << dt << " was taken";
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_NE(std::string(error.what()).find("dt must be above 0"), std::string::npos)
            << error.what();
      }
    }
  EXPECT_EQ(one.solver.state().t, other.solver.state().t);
  one.steps(1, 0.02), other.steps(1, 0.02);
  EXPECT_TRUE(one.state() == other.state());
}

TEST(Recovery, IsTheSmallerStepOnTriangles) {
  for (const int good : {6, 7}) expect_recovery({.simplex = true}, good);
}

TEST(Recovery, IsTheSmallerStepForThePaperScheme) {
  for (const int good : {6, 7})
    expect_recovery({.kinematics = KinematicsKind::left_cauchy_green, .G = 0.1}, good);
}

TEST(Recovery, IsTheSmallerStepWithTwoViscosities) {
  for (const int good : {6, 7}) expect_recovery({.mu_s = 0.1}, good);
}

using Tally = std::map<std::string, std::int64_t>;

TEST(Recovery, NamesAStiffSolid) {
  const Scene scene{.G = 1000};
  const Mesh mesh = mesh_of(scene);
  Trial one(mesh, scene), other(mesh, scene);
  one.steps(3, 0.002), other.steps(3, 0.002);
  const Real asked = 1.8 * one.solver.elastic_dt(), dt = one.solver.advance(asked);
  EXPECT_EQ(dt, asked / 2);
  EXPECT_EQ(one.solver.report().rejections,
            (Tally{{"the solid became too stiff for the step", 1}}));
  EXPECT_EQ(other.solver.advance(dt), dt);
  EXPECT_TRUE(one.state() == other.state());
}

/// A disc drawn far along y, whose log B turns fast although the flow is slow: u = s (y, x)
/// everywhere, from some time on.
struct Drawn {
  Drawn(const Mesh& mesh, Real onset)
      : solver(mesh, {.rho = 1, .mu_f = 0.01},
               {.conditions = {{"top", wall(onset)},
                               {"left", wall(onset)},
                               {"right", wall(onset)},
                               {"bottom", wall(onset)}}}) {
    solver.start([&](const Vec3& x) { return wall(onset).u(x, 0); });
    solver.put_solid(
        {.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}), .G = 1e-6, .mu = 0.01});
    solver.body()->set_B(
        [](const Vec3&) { return SymTensor{std::exp(-8), 0, 0, std::exp(8), 0, 1}; });
  }
  static FixedVelocity wall(Real onset) {
    return {[onset](const Vec3& x, Real t) {
      return t < onset - 1e-9 ? Vec3{} : Vec3{x.y - 0.5, x.x - 0.5, 0};
    }};
  }
  Solver solver;
};

TEST(Recovery, NamesASolidThatStrains) {
  const Mesh mesh = mesh_of({});
  Drawn run(mesh, 0);
  ASSERT_EQ(run.solver.advance(1e-3), 1e-3) << run.solver.report().failure;
  const Real asked = 1.5 * run.solver.strain_dt(0.5);
  ASSERT_LT(asked, 0.9 * run.solver.advective_dt(1)) << "it is not the flow that is too fast";
  EXPECT_EQ(run.solver.advance(asked), asked / 2);
  EXPECT_TRUE(run.solver.report().held_back);
  EXPECT_EQ(run.solver.report().rejections, (Tally{{"the solid strains too much in the step", 1}}));
}

TEST(Recovery, TakesTheSolidsStepInPartsWhereTheOneBeforeWasTooLong) {
  // The solid moves on by half the step before the onset, whatever the one after it is.
  const Mesh mesh = mesh_of({});
  constexpr Real onset = 0.1, long_step = 0.075, dt = 1e-3;
  Drawn run(mesh, onset);
  ASSERT_EQ(run.solver.advance(onset - long_step), onset - long_step);
  ASSERT_EQ(run.solver.advance(long_step), long_step) << run.solver.report().failure;
  ASSERT_EQ(run.solver.advance(dt), dt) << run.solver.report().failure;
  const solid::Strain strain = run.solver.body()->strain;
  const Real rate = global_max(strain.rate);
  EXPECT_GT(rate * (long_step + dt) / 2, 0.5) << "more than a step may strain";
  EXPECT_LT(rate * dt, 0.1) << "but the flow's step is short";
  EXPECT_LE(global_max(strain.of_part), 0.5);
}

TEST(Recovery, NamesTheCrushedCellAndNoSpeckOfSolid) {
  const Mesh mesh = mesh_of({});
  constexpr Real never = 100;
  Drawn run(mesh, never);
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (norm(mesh.C[c] - Vec3{0.1, 0.9, 0}) < 0.05) run.solver.body()->alpha[c] = 1e-12;
  mesh.halo.update(run.solver.body()->alpha);
  run.solver.body()->set_B(
      [](const Vec3&) { return SymTensor{std::exp(-10), 0, 0, std::exp(10), 0, 1}; });
  EXPECT_EQ(run.solver.advance(1e-3), 0);
  const std::string& said = run.solver.report().failure;
  EXPECT_NE(said.find("the smallest eigenvalue of B fell below 1e-4"), std::string::npos) << said;
  Vec3 x;
  const std::size_t at = said.find(" at (");
  ASSERT_NE(at, std::string::npos) << said;
  ASSERT_EQ(std::sscanf(said.c_str() + at, " at (%lf, %lf", &x.x, &x.y), 2) << said;
  EXPECT_LT(norm(x - Vec3{0.5, 0.5, 0}), 0.25) << said;
}

TEST(Recovery, NamesABodyForceThatNoStepCanFollow) {
  const Mesh mesh = test::read_box({.n = {n, n, 0}, .periodic = {"left", "right"}});
  constexpr Real onset = 0.02, dt = onset;
  for (const Real size : {1e30, std::numeric_limits<Real>::infinity()}) {
    const bool finite = std::isfinite(size);
    const auto force = [=](const Vec3& x, Real t) {
      return t > onset && x.x > 0.5 ? Vec3{size, 0, 0} : Vec3{1, 0, 0};
    };
    Solver solver(mesh, {.rho = 1, .mu_f = 0.01},
                  {.conditions = {{"top", Wall{}}, {"bottom", Wall{}}}, .body_force = force});
    solver.start([](const Vec3&) { return Vec3{}; });
    ASSERT_EQ(solver.advance(dt), dt);
    ASSERT_EQ(solver.advance(100 * dt), 0);
    const std::string& said = solver.report().failure;
    std::printf("%s\n", said.c_str());
    EXPECT_NE(said.find(finite ? "the body force is 1e+30 at (0." : "body force is not finite"),
              std::string::npos)
        << said;
    EXPECT_EQ(said.find("hex"), std::string::npos) << said;
    EXPECT_EQ(solver.state().t, dt);
  }
}

TEST(Recovery, NamesASolidThatIsCarriedTooFar) {
  // Two steps at a Courant number below the flow's limit of 1.2, the solid's move above one.
  const Scene scene{.G = 1e-6};
  const Mesh mesh = test::read_box({.n = {n, n, 0}, .periodic = {"left", "right"}});
  const FixedVelocity wall{[](const Vec3&, Real) { return Vec3{1, 0, 0}; }};
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01}, {.conditions = {{"top", wall}, {"bottom", wall}}});
  solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });
  solver.put_solid(
      {.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}), .G = scene.G, .mu = 0.01});
  const Real cell = 1.0 / n;
  ASSERT_EQ(solver.advance(0.9 * cell), 0.9 * cell) << solver.report().failure;
  EXPECT_NEAR(solver.carried_dt(), cell, 1e-6);
  EXPECT_EQ(solver.advance(1.15 * cell), 1.15 * cell / 2);
  EXPECT_EQ(solver.report().rejections, (Tally{{"the solid moved by more than a cell", 1}}));
  // What carried_dt allows is not rejected.
  const Real allowed = std::min(solver.carried_dt(), 1.1 * 1.15 * cell / 2);
  EXPECT_EQ(solver.advance(allowed), allowed);
  EXPECT_EQ(solver.report().rejected, 1);
}

/// PETSc options for the time of a test.
struct Given {
  explicit Given(const char* options) { FSI_PETSC(PetscOptionsInsertString(nullptr, options)); }
  Given(const Given&) = delete;
  Given& operator=(const Given&) = delete;
  ~Given() { static_cast<void>(PetscOptionsClear(nullptr)); }
};

TEST(Recovery, NamesAFlowThatIsNotDivergenceFree) {
  // What the pressure solve leaves is ten times what a step of this length may.
  const Real dt = 0.02, cells_norm = 1.0 / n, allowed = 1e-4 * cells_norm / dt;
  const Given given(("-p_ksp_type cg -p_pc_type jacobi -p_ksp_rtol 1e-12 -p_ksp_atol " +
                     std::to_string(3 * allowed))
                        .c_str());
  const Mesh mesh = mesh_of({});
  Trial run(mesh, {});
  const StepReport& report = run.solver.report();
  Real taken = dt;
  for (int i = 0; i < 20 && report.rejected == 0; ++i) taken = run.solver.advance(dt);
  std::printf("rejected %d taken %g\n", int(report.rejected), taken);
  EXPECT_EQ(report.rejections, (Tally{{"the flow is not divergence-free", report.rejected}}));
  ASSERT_GT(report.rejected, 0);
  EXPECT_EQ(taken, std::ldexp(dt, -static_cast<int>(report.rejected)));
  EXPECT_LE(report.pressure_residual * taken, 1e-4 * cells_norm);
}

/// Nine tries fail for that reason; the state is what it was.
void expect_failure(Trial& run, Real dt, const std::string& reason, const std::string& place) {
  const std::vector<Real> before = run.state();
  const StepReport& report = run.solver.report();
  const std::int64_t rejected = report.rejected;
  EXPECT_EQ(run.solver.advance(dt), 0);
  EXPECT_EQ(report.rejected, rejected + 9);
  EXPECT_EQ(run.rejections(), report.rejected);
  EXPECT_NE(report.failure.find(reason), std::string::npos) << report.failure;
  EXPECT_NE(report.failure.find(place), std::string::npos) << report.failure;
  const std::string step = "step " + std::to_string(run.solver.state().step + 1) + " from t = ";
  EXPECT_EQ(report.failure.find(step), 0) << report.failure;
  EXPECT_TRUE(run.state() == before) << "the state is the last good one";
}

TEST(Recovery, GivesUpAtASpeedThatNoHalvingReaches) {
  for (const bool simplex : {false, true}) {
    const Scene scene{.simplex = simplex};
    const Mesh mesh = mesh_of(scene);
    Trial one(mesh, scene), other(mesh, scene);
    one.steps(4, 0.02), other.steps(4, 0.02);
    expect_failure(one, 200, "the flow became too fast for the step",
                   std::string("in a ") + (simplex ? "triangle" : "quad") + " of aspect ratio 1");
    // It could go on from there as if nothing had been tried.
    one.steps(3, 0.02), other.steps(3, 0.02);
    EXPECT_TRUE(one.state() == other.state());
  }
}

TEST(Recovery, GivesUpOnABoundaryThatIsNotANumber) {
  const FixedVelocity lid{[](const Vec3&, Real t) {
    return Vec3{t > 0.080001 ? std::numeric_limits<Real>::quiet_NaN() : 1, 0, 0};
  }};
  const Scene scene{.lid = lid};
  const Mesh mesh = mesh_of(scene);
  Trial one(mesh, scene), other(mesh, scene);
  one.steps(3, 0.02), other.steps(3, 0.02);
  const Real dt = one.solver.advance(0.03);
  EXPECT_EQ(dt, 0.015);
  EXPECT_EQ(other.solver.advance(dt), dt);
  EXPECT_TRUE(one.state() == other.state());
  EXPECT_EQ(one.solver.advance(0.005), 0.005);
  expect_failure(one, 0.1, "did not converge: DIVERGED_NANORINF",
                 "the first value that is not finite is at (");
}

TEST(Recovery, GivesUpOnACrushedSolid) {
  const Scene scene{.G = 1e-6};
  const Mesh mesh = mesh_of(scene);
  Trial run(mesh, scene);
  run.solver.body()->set_B([](const Vec3&) { return SymTensor{5e-5, 0, 0, 2e4, 0, 1}; });
  expect_failure(run, 1e-3, "the smallest eigenvalue of B fell below 1e-4",
                 "the largest inverse of an eigenvalue of B is 2e+04 at (");
}

// Limits that shrink with the flow's speed let a run that blows up go on for ever without coming
// on.
TEST(Recovery, EndsARunWhoseStepsBecomeTiny) {
  const Scene scene;
  const Mesh mesh = mesh_of(scene);
  Trial trial(mesh, scene);
  trial.steps(1, 1e-3);
  trial.steps(100, 1e-10);
  trial.steps(1, 1e-3);  // as after an event
  trial.steps(100, 1e-10);
  const Real t = trial.solver.state().t;
  EXPECT_EQ(trial.solver.advance(1e-10), 0);
  EXPECT_EQ(trial.solver.state().t, t);
  const std::string& failure = trial.solver.report().failure;
  EXPECT_NE(failure.find("a hundred steps in a row of less than a millionth of the largest"),
            std::string::npos)
      << failure;
  EXPECT_NE(failure.find(" in a quad of aspect ratio 1 "), std::string::npos) << failure;
}

// Fields are looked at between steps with the solid at the flow's time.
TEST(Recovery, LookingAtTheFieldsChangesNothing) {
  for (const bool simplex : {false, true})
    for (const KinematicsKind kinematics :
         {KinematicsKind::log_conformation, KinematicsKind::reference_map}) {
      const Scene scene{.simplex = simplex, .kinematics = kinematics};
      const Mesh mesh = mesh_of(scene);
      Trial one(mesh, scene), other(mesh, scene);
      for (int i = 0; i < 4; ++i) {
        one.steps(3, 0.02), other.steps(3, 0.02);
        other.solver.at_one_time([&] {
          const Body& body = other.solver.bodies().front();
          EXPECT_EQ(body.t, other.solver.state().t);
          EXPECT_NE(body.t, one.solver.bodies().front().t);
        });
      }
      EXPECT_EQ(one.state(), other.state()) << simplex;
    }
}

}  // namespace
}  // namespace fsi
