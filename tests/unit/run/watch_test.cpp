// Words on standard error: where they come and what they name.

#include "libfsi/run/watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

const Vec3 centre{0.3, 0.6, 0};

/// A disc at rest in a box that is periodic in all directions.
struct Disc {
  Mesh mesh = test::read_box({.n = {16, 16, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver{mesh, {.rho = 1, .mu_f = 0.1}, {}};
  explicit Disc(Real speed = 0) {
    solver.start([speed](const Vec3&) { return Vec3{speed, 0, 0}; });
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), centre), .G = 1, .mu = 0.1});
  }
};

TEST(Watch, AnOddEnergyIsToldWithThePlaceOfStrain) {
  Disc disc;
  Watch watch(1);
  EXPECT_EQ(watch.energy(0.05, disc.solver), "");
  testing::internal::CaptureStderr();
  EXPECT_EQ(watch.energy(0.2, disc.solver), "") << "a warning, and the run goes on";
  const std::string warning = testing::internal::GetCapturedStderr();
  const std::string end = watch.energy(0.6, disc.solver);
  for (const std::string& text : {rank() == 0 ? warning : end, end}) {
    const std::size_t at = text.find("strained most at (");
    ASSERT_NE(at, std::string::npos) << text;
    Vec3 x;
    ASSERT_EQ(std::sscanf(text.c_str() + at, "strained most at (%lf, %lf, %lf)", &x.x, &x.y, &x.z),
              3);
    EXPECT_LT(norm(x - centre), 0.2 + 1.0 / 16) << text;
  }
}

// A block on the floor. Its bond is told of once more than a fifth of it is bare.
TEST(Watch, ABareBondIsToldOnce) {
  const Mesh mesh = test::read_box({.n = {20, 10, 0}, .length = {2, 1, 1}});
  Solver solver{
      mesh,
      {.rho = 1, .mu_f = 0.1},
      {.conditions = {
           {"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}, {"top", Wall{{1, 0, 0}}}}}};
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid(
      {.shape = shapes::translate(shapes::box({0.8, 0.4, 9}), {1, 0.2, 0}), .G = 1, .mu = 0.1});
  Body& body = *solver.body();
  EXPECT_EQ(body.bonded_faces, 8);
  EXPECT_EQ(body.sliding_faces, 0);
  EXPECT_EQ(body.bond_kept(), 1);
  Watch watch(1);
  const EnergyBalance energy(solver);
  const auto said = [&](Real bare_to) {
    for (Index c = 0; c < mesh.n_cells; ++c)
      if (mesh.C[c].x < bare_to) body.alpha[c] = 0;
    testing::internal::CaptureStderr();
    watch.strain(0, solver, {.bond_kept = body.bond_kept()}, energy);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(0.7), "") << "one face of eight";
  const std::string warning = said(0.8);
  if (rank() == 0) {
    EXPECT_NE(warning.find("covers only 75 % of the faces of walls"), std::string::npos) << warning;
  }
  EXPECT_EQ(said(1), "");
}

TEST(Watch, AMapThatLostItsVolumeIsToldOnce) {
  Disc disc;
  Watch watch(1);
  const EnergyBalance energy(disc.solver);
  const auto said = [&](Real least, Real most) {
    testing::internal::CaptureStderr();
    watch.strain(0, disc.solver, {.map_det_min = least, .map_det_max = most}, energy);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(0.6, 1.5), "");
  const std::string warning = said(0.4, 1.5);
  if (rank() == 0) {
    EXPECT_NE(warning.find("wrong by a factor of 2.5 in volume"), std::string::npos) << warning;
  }
  EXPECT_EQ(said(-1, 5), "");
}

// Two discs in a channel: the first comes to the floor, and then to the second.
TEST(Watch, FilmsThatTheMeshDoesNotResolveAreToldOnce) {
  const Mesh mesh = test::read_box({.n = {20, 20, 0}, .periodic = {"left", "right"}});
  for (const KinematicsKind kinematics :
       {KinematicsKind::log_conformation, KinematicsKind::reference_map}) {
    Solver solver{
        mesh, {.rho = 1, .mu_f = 0.1}, {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}}};
    solver.start([](const Vec3&) { return Vec3{}; });
    const auto put = [&](const char* name, Real x) {
      const shapes::Shape disc = shapes::translate(shapes::sphere(0.15), {x, 0.5, 0});
      solver.put_solid({.shape = disc, .G = 1, .mu = 0.1, .name = name, .kinematics = kinematics});
    };
    put("a", 0.25), put("b", 0.75);
    Watch watch(2);
    const EnergyBalance energy(solver);
    const auto said = [&](const Vec3& at, Real fraction) {
      for (Index c = 0; c < mesh.n_cells; ++c)
        if (norm(mesh.C[c] - at) < 0.03) solver.body()->alpha[c] = fraction;
      solver.body()->band.rebuild(solver.body()->alpha, 0.01);
      testing::internal::CaptureStderr();
      for (std::size_t i = 0; i < 2; ++i) watch.strain(i, solver, {}, energy);
      return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(said({0.275, 0.075, 0}, 1), "") << "a cell off the floor";
    EXPECT_EQ(said({0.275, 0.025, 0}, 0.4), "") << "more than half a cell of fluid";
    const std::string at_wall = said({0.275, 0.025, 0}, 0.6), at_other = said({0.775, 0.475, 0}, 1);
    if (rank() == 0) {
      const char* expected = kinematics == KinematicsKind::log_conformation
                                 ? "film between solid a and bottom is thinner than half a cell"
                                 : "solid a touches bottom and sticks to it: with reference_map";
      EXPECT_NE(at_wall.find(expected), std::string::npos) << at_wall;
      EXPECT_NE(at_other.find("film between solid a and solid b is thinner than a cell"),
                std::string::npos)
          << at_other;
    }
    EXPECT_EQ(said({0.775, 0.525, 0}, 1), "");
  }
}

// A disc a cell off a plane of symmetry, then half a cell; and one that the plane cuts.
TEST(Watch, AFilmToTheImageAtAPlaneOfSymmetryIsThin) {
  const Mesh mesh = test::read_box({.n = {20, 20, 0}, .periodic = {"left", "right"}});
  for (const auto& [y, thin] : {std::pair{0.25, false}, {0.222, true}, {0.1, false}}) {
    Solver solver{
        mesh, {.rho = 1, .mu_f = 0.1}, {.conditions = {{"bottom", Slip{}}, {"top", Wall{}}}}};
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid(
        {.shape = shapes::translate(shapes::sphere(0.2), {0.525, y, 0}), .G = 1, .mu = 0.1});
    Watch watch(1);
    testing::internal::CaptureStderr();
    watch.strain(0, solver, {}, EnergyBalance(solver));
    const std::string said = testing::internal::GetCapturedStderr();
    if (rank() == 0) {
      EXPECT_EQ(said.find("its image at bottom is thinner than a cell") != std::string::npos, thin)
          << y << said;
    }
  }
}

TEST(Watch, AFilmBetweenTwoFullCellsOfTwoSolidsIsThin) {
  const Mesh mesh = test::read_box({.n = {20, 20, 0}, .periodic = {"left", "right"}});
  // The films, of 0.2 and 1.8 cells, have a face of the mesh in their middle.
  for (const Real half : {0.005, 0.045}) {
    Solver two{
        mesh, {.rho = 1, .mu_f = 0.1}, {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}}};
    two.start([](const Vec3&) { return Vec3{}; });
    for (const Real side : {-1.0, 1.0})
      two.put_solid(
          {.shape = shapes::translate(shapes::sphere(0.2), {0.5 + side * (0.2 + half), 0.475, 0}),
           .G = 1,
           .mu = 0.1,
           .name = side < 0 ? "a" : "b"});
    Watch watch(2);
    testing::internal::CaptureStderr();
    watch.strain(0, two, {}, EnergyBalance(two));
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(text.find("film between solid a and solid b") != std::string::npos,
              rank() == 0 && half < 0.01)
        << text;
  }
}

TEST(Watch, APartThatComesBackFromAnOpeningIsToldOnce) {
  const Mesh mesh = test::read_box({.n = {20, 20, 0}, .periodic = {"bottom", "top"}});
  Solver solver{mesh,
                {.rho = 1, .mu_f = 0.1},
                {.conditions = {{"left", Wall{}}, {"right", Opening{.pressure = 0}}}}};
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid(
      {.shape = shapes::translate(shapes::sphere(0.2), {0.7, 0.5, 0}), .G = 1, .mu = 0.1});
  Body& body = *solver.body();
  Watch watch(1);
  const auto said = [&](Real out, Real at_opening) {
    body.volume_out = out * body.filled.volume;
    for (Index c = 0; c < mesh.n_cells; ++c)
      if (norm(mesh.C[c] - Vec3{0.975, 0.475, 0}) < 0.01) body.alpha[c] = at_opening;
    testing::internal::CaptureStderr();
    watch.leaving(solver);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(0, 0), "");
  const std::string leaves = said(0.4, 1), off = said(0.4, 0);
  EXPECT_EQ(leaves.find("no opening cuts"), std::string::npos) << leaves;
  if (rank() == 0) {
    EXPECT_NE(leaves.find("solid leaves the mesh"), std::string::npos) << leaves;
    EXPECT_NE(off.find("no opening cuts solid any more: 60 % of it"), std::string::npos) << off;
  }
  EXPECT_EQ(said(0.4, 0), "");
  Watch later(1);
  testing::internal::CaptureStderr();
  later.resume(solver), later.leaving(solver);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the run before this one told it";
}

TEST(Watch, StepsTakenBackAreToldOnceWithTheReasonOfMost) {
  Watch watch(0), of_fixed(0);
  const auto said = [](Watch& of, const std::string& limit, std::int64_t few, std::int64_t many,
                       std::int64_t steps) {
    StepReport report;
    report.rejections = {{"one reason", few}, {"another", many}};
    testing::internal::CaptureStderr();
    of.taken_back(report, steps, {.dt = 0.25, .name = limit});
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(watch, "advective", 2, 17, 30), "") << "too few";
  EXPECT_EQ(said(watch, "advective", 2, 18, 300), "") << "not one in ten";
  const std::string notice = said(watch, "advective", 2, 38, 300),
                    fixed = said(of_fixed, "fixed", 0, 1, 300);
  if (rank() == 0) {
    EXPECT_NE(notice.find("40 attempts at a step failed in 300 steps"), std::string::npos)
        << notice;
    EXPECT_NE(notice.find("another"), std::string::npos) << notice;
    EXPECT_NE(fixed.find("another; -time_step 0.25 is too long"), std::string::npos) << fixed;
  }
  EXPECT_EQ(said(watch, "advective", 2, 100, 310), "");
}

TEST(Watch, AFlowPastTheLaminarIsToldOnce) {
  const auto said = [](Watch& watch, Real number) {
    testing::internal::CaptureStderr();
    watch.reynolds(number);
    return testing::internal::GetCapturedStderr();
  };
  Watch watch(0);
  EXPECT_EQ(said(watch, 3900), "");
  const std::string warning = said(watch, 5120);
  if (rank() == 0) {
    EXPECT_NE(warning.find("5.12e+03"), std::string::npos) << warning;
  }
  EXPECT_EQ(said(watch, 6000), "");
}

// A disc between two parallel planes has no end of images; in a corner it has three.
TEST(Watch, ASolidWithoutAWholeIsTold) {
  const Mesh mesh = test::read_box({.n = {16, 16, 0}});
  const auto said = [&mesh](Real radius, const Vec3& at) {
    Solver solver(
        mesh, {.rho = 1, .mu_f = 0.1},
        {.conditions = {{"left", Slip{}}, {"right", Wall{}}, {"bottom", Slip{}}, {"top", Slip{}}}});
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid({.shape = shapes::translate(shapes::sphere(radius), at), .G = 1, .mu = 0.1});
    testing::internal::CaptureStderr();
    tell_of_solids(solver);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(0.4, {0, 0, 0}), "");
  const std::string text = said(0.6, {0, 0.5, 0});
  EXPECT_EQ(text.find("parallel") != std::string::npos, rank() == 0) << text;
}

// Viscosity cannot take in a step what is neither stored nor put in.
TEST(Watch, AVelocityThatAlternatesIsToldByItsDissipation) {
  const Mesh mesh =
      test::read_box({.n = {4, 4, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver(mesh, {.rho = 2, .mu_f = 0.1}, {});
  solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });  // a stored energy of 1
  const EnergyBalance energy(solver);
  Watch watch(0);
  const auto said = [&](Real taken, Real dt) {
    testing::internal::CaptureStderr();
    watch.flow({{"dissipation", taken}}, energy, dt, 0.5);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(1e3, 0), "") << "not judged yet";
  EXPECT_EQ(said(9, 0.1), "") << "of what is stored";
  const std::string text = said(11, 0.1);
  EXPECT_EQ(text.find("at t = 0.5 viscosity takes 11 per unit of time") != std::string::npos,
            rank() == 0)
      << text;
  EXPECT_EQ(said(11, 0.1), "") << "once";
}

// What viscosity takes was stored before, or put in.
TEST(Watch, DissipationThatNothingFeedsIsTold) {
  const Mesh mesh =
      test::read_box({.n = {4, 4, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver(mesh, {.rho = 2, .mu_f = 0.1}, {});
  solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });  // a stored energy of 1
  const EnergyBalance energy(solver);
  const auto said = [&](Watch watch, Real taken, int rows) {
    testing::internal::CaptureStderr();
    for (int i = 0; i <= rows; ++i) watch.flow({{"dissipation", taken}}, energy, 0.01, 0.1 * i);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(Watch(0), 0.9, 22), "") << "less than twice what is stored";
  EXPECT_EQ(said(Watch(0), 9, 19), "") << "of too few rows";
  const std::string text = said(Watch(0), 9, 60);
  EXPECT_EQ(text.find("between t = 0 and 2 100 % of what viscosity takes") != std::string::npos,
            rank() == 0)
      << text;
  EXPECT_EQ(text.rfind("between"), text.find("between")) << "once";
}

// A shear wave that has nothing to live on, with no row at all, with a solid of another viscosity.
TEST(Watch, DissipationIsJudgedBetweenRows) {
  const Mesh mesh =
      test::read_box({.n = {4, 16, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver(mesh, {.rho = 2, .mu_f = 0.1}, {});
  const Real k = 2 * std::numbers::pi;
  solver.start([k](const Vec3& x) { return Vec3{std::sin(k * x.y), 0, 0}; });
  const auto disc = shapes::translate(shapes::sphere(0.1), {0.5, 0.5, 0});
  solver.put_solid({.shape = disc, .G = 1, .mu = 0.5, .rho = 2});
  const EnergyBalance energy(solver);
  const auto said = [&](Real dt, int steps) {
    Watch watch(1);
    testing::internal::CaptureStderr();
    for (int i = 1; i <= steps; ++i) {
      solver.state().t = 0.02 * i;
      watch.between_rows(solver, energy, dt);
    }
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(0, 200), "") << "not judged yet";
  EXPECT_EQ(said(0.02, 104), "") << "a value in five steps: one and nineteen";
  const std::string text = said(0.02, 200);
  EXPECT_EQ(text.find("between t = 0.1 and 2.1 100 % of what") != std::string::npos, rank() == 0)
      << text;
}

// Of 0.126: what a solid's specks are, which the flow sweeps ahead of it, is no leaving.
TEST(Watch, SpecksAreNoSolidThatLeaves) {
  Disc disc;
  Body& body = disc.solver.bodies().front();
  Watch watch(1);
  const auto said = [&](Real out) {
    body.volume_out = out;
    testing::internal::CaptureStderr();
    watch.leaving(disc.solver);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said(2e-30), "");
  EXPECT_EQ(said(1e-6), "");
  EXPECT_EQ(said(1e-4).empty(), rank() != 0);
}

TEST(Watch, StrainAndShapeAreToldApartOfASolidThatIsWhole) {
  for (const Real out : {0.0, 1e-3}) {
    Disc disc;
    disc.solver.bodies().front().volume_out = out;
    Watch watch(1);
    const EnergyBalance energy(disc.solver);
    testing::internal::CaptureStderr();
    watch.strain(0, disc.solver, {.elastic_energy = 0.03, .shape_energy = 0.01}, energy);
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(text.find("no longer belong") != std::string::npos, rank() == 0 && out == 0) << text;
  }
}

// An energy of 1e-4 is less than a thousandth of G V = 0.126: it matters beside the flow's 5e-5.
TEST(Watch, StrainAndShapeAreToldApartWhereTheFlowHasLess) {
  for (const Real speed : {0.01, 0.1}) {
    Disc disc(speed);
    Watch watch(1);
    const EnergyBalance energy(disc.solver);
    testing::internal::CaptureStderr();
    watch.strain(0, disc.solver, {.elastic_energy = 0, .shape_energy = 1e-4}, energy);
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(text.find("no longer belong") != std::string::npos, rank() == 0 && speed < 0.05)
        << text;
  }
}

}  // namespace
}  // namespace fsi
