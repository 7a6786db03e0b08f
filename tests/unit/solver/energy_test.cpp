#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/energy.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

// A shear by 1 stores G/2 of energy per volume, whatever the determinant of the paper's B has
// become.
TEST(ElasticEnergy, OfThePapersBIsThatOfItsShape) {
  const Mesh mesh =
      test::read_box({.n = {16, 16, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.1}, {});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}),
                    .G = 3,
                    .mu = 0.1,
                    .kinematics = KinematicsKind::left_cauchy_green});
  Body& body = solver.bodies().front();
  body.set_B([](const Vec3&) { return SymTensor{2, 1, 0, 1, 0, 1}; });
  const Real whole = 3 * 0.5 * body.filled.volume, energy = elastic_energy(body);
  EXPECT_NEAR(energy, whole,
              0.02 * whole);  // B is unknown in cells with less than a tenth of solid
  auto& Bt = std::get<solid::LeftCauchyGreen>(body.kinematics).Bt;
  for (Index c = 0; c < mesh.n_cells; ++c) Bt[c].xx *= 0.6, Bt[c].xy *= 0.6, Bt[c].yy *= 0.6;
  EXPECT_NEAR(elastic_energy(body), energy, 1e-12);
  // In a plane -B has the determinant of B.
  for (Index c = 0; c < mesh.n_cells; ++c) Bt[c].xx *= -1, Bt[c].xy *= -1, Bt[c].yy *= -1;
  EXPECT_NEAR(elastic_energy(body), 0, 1e-12);
}

// A uniform force in a periodic box: u = f t / rho, and all the work is kinetic energy.
TEST(EnergyBalance, TheWorkOfAForceIsStored) {
  const Mesh mesh =
      test::read_box({.n = {6, 6, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver(mesh, {.rho = 2, .mu_f = 0.1}, {.body_force = [](const Vec3&, Real) {
                  return Vec3{3, 0, 0};
                }});
  solver.start([](const Vec3&) { return Vec3{}; });
  EnergyBalance energy(solver);
  for (int i = 0; i < 20; ++i) {
    solver.step(0.01);
    energy.add(solver, 0.01);
  }
  EXPECT_NEAR(energy.stored(), 0.5 * 2 * std::pow(3 * 0.2 / 2, 2), 1e-10);
  EXPECT_NEAR(energy.work(), energy.stored(), 1e-10);
  EXPECT_LE(energy.part_made(), 1e-9);
  EXPECT_FALSE(energy.started());
  energy.add(solver, 0.01);
  EXPECT_TRUE(energy.started());
}

// u = (x, -y) and a rotation, given all around: the power is what viscosity takes, 4 mu and 0 per
// area, on meshes whose boundary faces are oblique to the cells, too.
TEST(EnergyBalance, ThePowerOfGivenVelocitiesIsWhatViscosityTakes) {
  for (const bool simplex : {false, true})
    for (const Real sheared : {0.0, 0.5, -1.0}) {
      const Mesh mesh =
          test::read_box({.n = {12, 12, 0}, .simplex = simplex, .moved = [=](const Vec3& x) {
                            return x + Vec3{sheared * x.y, 0, 0};
                          }});
      for (const bool turns : {false, true}) {
        const auto flow = [turns](const Vec3& x, Real) {
          return turns ? Vec3{x.y, -x.x, 0} : Vec3{x.x, -x.y, 0};
        };
        const FixedVelocity given{flow};
        Solver solver(
            mesh, {.rho = 1, .mu_f = 1},
            {.conditions = {{"left", given}, {"right", given}, {"bottom", given}, {"top", given}}});
        solver.start([&](const Vec3& x) { return flow(x, 0); });
        EnergyBalance energy(solver);
        for (int i = 0; i < 30; ++i) solver.step(0.01), energy.add(solver, 0.01);
        const Real before = energy.work();
        for (int i = 0; i < 10; ++i) solver.step(0.01), energy.add(solver, 0.01);
        const Real exact = turns ? 0 : 4;
        EXPECT_NEAR((energy.work() - before) / 0.1, exact, 0.02) << simplex << sheared;
        EXPECT_NEAR(energy.power(), exact, 0.02) << simplex << sheared;
      }
    }
}

// The pressure bears a uniform force in a closed box. What a step leaves of it in cells at walls is
// no energy that came from nothing, and the force does no work.
// The steps take the force at their middles; the balance takes it at their ends, too.
TEST(EnergyBalance, NamesAForceThatIsNotFinite) {
  const Mesh mesh =
      test::read_box({.n = {6, 6, 0}, .periodic = {"left", "right", "bottom", "top"}});
  const auto force = [](const Vec3&, Real t) {
    return Vec3{t > 0.19 && t < 0.21 ? std::nan("") : 1, 0, 0};
  };
  Solver solver(mesh, {.rho = 1, .mu_f = 0.1}, {.body_force = force});
  solver.start([](const Vec3&) { return Vec3{}; });
  EnergyBalance energy(solver);
  solver.step(0.1);
  energy.add(solver, 0.1);
  solver.step(0.1);
  try {
    energy.add(solver, 0.1);
    FAIL() << "a force that is not finite went unseen";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerics);
    EXPECT_STREQ(error.what(), "the body force is not finite at t = 0.2");
  }
  EXPECT_TRUE(std::isfinite(energy.work()));
}

TEST(EnergyBalance, AForceThatThePressureBearsDoesNoWork) {
  constexpr Real frequency = 2 * std::numbers::pi, dt = 0.04;
  const auto shaken = [](const Vec3&, Real t) { return Vec3{std::cos(frequency * t), 0, 0}; };
  for (const bool simplex : {false, true})
    for (const Real mu : {1e-3, 0.1}) {
      const Mesh mesh = test::read_box({.n = {12, 12, 0}, .simplex = simplex});
      Conditions walls;
      for (const char* name : {"left", "right", "bottom", "top"}) walls[name] = Wall{};
      Solver solver(mesh, {.rho = 1, .mu_f = mu}, {.conditions = walls, .body_force = shaken});
      solver.start([](const Vec3&) { return Vec3{}; });
      EnergyBalance energy(solver);
      for (int i = 0; i < 100; ++i) {
        solver.step(dt);
        energy.add(solver, dt);
      }
      EXPECT_LE(std::abs(energy.work()), 1e-8) << mu;
      EXPECT_LE(energy.part_made(), 0.05) << mu;
    }
}

// A layer of another density falls with all the fluid of a column without ends: f of the height,
// ratio r, and all the work of its weight is kinetic energy,
//   M u = f (r - 1) g t,  M = 1 + f (r - 1),  E = M u^2 / 2.
TEST(EnergyBalance, TheWorkOfAWeightIsStored) {
  constexpr Real part = 0.4, g = 3, dt = 5e-3;
  for (const bool simplex : {false, true})
    for (const Real ratio : {0.5, 5.0}) {
      const Mesh mesh = test::read_box({.n = {4, 16, 0},
                                        .length = {0.25, 1, 1},
                                        .simplex = simplex,
                                        .periodic = {"left", "right", "bottom", "top"}});
      Solver solver(mesh, {.rho = 1, .mu_f = 0.01, .gravity = {0, -g, 0}}, {.axis = {0, 1, 0}});
      solver.start([](const Vec3&) { return Vec3{}; });
      solver.put_solid({.shape = shapes::translate(shapes::box({200, part, 200}), {0, 0.53, 0}),
                        .G = 1,
                        .mu = 0.01,
                        .rho = ratio});
      EnergyBalance energy(solver);
      constexpr int steps = 100;
      for (int i = 0; i < steps; ++i) {
        solver.step(dt);
        energy.add(solver, dt);
      }
      const Real M = 1 + part * (ratio - 1), u = (M - 1) / M * g * steps * dt;
      const Real exact = mesh.total_volume * M * u * u / 2;
      EXPECT_NEAR(energy.stored() / exact, 1, 5e-3);
      EXPECT_NEAR(energy.work() / exact, 1, 5e-3);
      EXPECT_LE(energy.part_made(), 5e-3);
    }
}

// So it does with an acceleration of the solid alone, whatever its density: a disc in a closed box.
TEST(EnergyBalance, TheWorkOfAnAccelerationIsThatOfAWeight) {
  std::array<Real, 2> work{};
  for (const Real ratio : {1.0, 1.001}) {
    const Mesh mesh = test::read_box({.n = {24, 24, 0}});
    Conditions walls;
    for (const char* name : {"left", "right", "bottom", "top"}) walls[name] = Wall{};
    Solver solver(mesh, {.rho = 1, .mu_f = 0.05}, {.conditions = walls});
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}),
                      .G = 2,
                      .mu = 0.05,
                      .acceleration = {0, -1 / ratio, 0},
                      .rho = ratio});
    EnergyBalance energy(solver);
    for (int i = 0; i < 60; ++i) solver.step(0.005), energy.add(solver, 0.005);
    EXPECT_LE(energy.part_made(), 1e-3);
    work[ratio > 1 ? 1 : 0] = energy.work();
  }
  EXPECT_GT(work[0], 1e-4);
  EXPECT_NEAR(work[1] / work[0], 1, 0.01);
}

// What the weight of a disc in a box does less what is stored and what viscosity takes,
//   mu (L : L + L : L^T),
// as a part of the work. L of cells is blunt at the kink of u at the surface: it falls with h.
Real lost(Real ratio, Index n) {
  constexpr Real mu = 0.05;
  const Mesh mesh = test::read_box({.n = {n, n, 0}});
  Conditions walls;
  for (const char* name : {"left", "right", "bottom", "top"}) walls[name] = Wall{};
  Solver solver(mesh, {.rho = 1, .mu_f = mu, .gravity = {0, -1, 0}}, {.conditions = walls});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}),
                    .G = 2,
                    .mu = mu,
                    .rho = ratio});
  EnergyBalance energy(solver);
  Real taken = 0, before = 0;
  while (solver.state().t < 0.6) {
    const Real dt = solver.advance(std::min({0.01, solver.advective_dt(0.5), solver.elastic_dt()}));
    if (dt == 0) return 1;
    energy.add(solver, dt);
    const CellField<Tensor>& L = solver.velocity_gradient();
    Sum sum;
    for (Index c = 0; c < mesh.n_owned; ++c)
      sum.add(mu * mesh.V[c] * (trace(dot(L[c], transpose(L[c]))) + trace(dot(L[c], L[c]))));
    const Real now = sum.total();
    taken += dt * (before + now) / 2;
    before = now;
  }
  EXPECT_LE(energy.part_made(), 1e-3);
  const Real part = 1 - (energy.stored() + taken) / energy.work();
  std::printf("disc of density %g, %d cells: work %.4e, stored %.4e, taken %.4e, lost %.3f\n",
              ratio, n, energy.work(), energy.stored(), taken, part);
  return part;
}

TEST(EnergyBalance, TheWorkOfAFallingDiscIsFoundAgain) {
  for (const Real ratio : {0.5, 5.0}) {
    const Real coarse = lost(ratio, 32), fine = lost(ratio, 64);
    EXPECT_GE(fine, 0);
    EXPECT_LE(fine, 0.06);
    EXPECT_LE(fine, 0.6 * coarse);
  }
}

// A plug of another density between slippery walls leaves with the flow and takes its energy along.
TEST(EnergyBalance, ASolidThatLeavesTakesItsEnergyAlong) {
  const Mesh mesh = test::read_box({.n = {40, 4, 0}, .length = {2, 0.2, 1}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01},
                {.conditions = {{"left", FixedVelocity{[](const Vec3&, Real) {
                                   return Vec3{1, 0, 0};
                                 }}},
                                {"right", Opening{}},
                                {"bottom", Slip{}},
                                {"top", Slip{}}}});
  solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });
  solver.put_solid({.shape = shapes::translate(shapes::box({0.4, 200, 200}), {1.2, 0, 0}),
                    .G = 0.1,
                    .mu = 0.01,
                    .rho = 3});
  EnergyBalance energy(solver);
  EXPECT_NEAR(energy.stored(), 0.2 * (1.6 + 3 * 0.4) / 2, 1e-9);
  for (int i = 0; i < 60; ++i) {
    solver.step(0.02);
    energy.add(solver, 0.02);
  }
  EXPECT_NEAR(energy.stored(), 0.2, 1e-3);
  EXPECT_NEAR(energy.work(), -0.2 * 0.4, 2e-3);
  EXPECT_LE(energy.part_made(), 0.01);
}

// Flow between plates that slide: once it is steady, the work is what viscosity takes,
//   mu (U / H)^2 per volume and time.
TEST(EnergyBalance, ThePlatesDoWhatViscosityTakes) {
  const Mesh mesh = test::read_box({.n = {4, 8, 0}, .periodic = {"left", "right"}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.5},
                {.conditions = {{"top", Wall{{1, 0, 0}}}, {"bottom", Wall{}}}});
  solver.start([](const Vec3& x) { return Vec3{x.y, 0, 0}; });
  EnergyBalance energy(solver);
  for (int i = 0; i < 10; ++i) {
    solver.step(0.02);
    energy.add(solver, 0.02);
  }
  EXPECT_NEAR(energy.work(), 0.5 * 0.2, 1e-9);
  EXPECT_EQ(energy.made(), 0);
}

// The level of the pressure does no work on what flows through, however large it is and however it
// changes: what it does at the inlet it takes back at the outlet.
TEST(EnergyBalance, ALevelThatPulsesDoesNoWork) {
  const Mesh mesh = test::read_box({.n = {16, 8, 0}, .length = {2, 1, 1}, .simplex = true});
  const OfTime pulse([](Real t) { return 1e4 + 2e3 * std::sin(2 * std::numbers::pi * t); });
  Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                {.conditions = {{"left", FlowRate{.rate = 0.5}},
                                {"right", Opening{pulse}},
                                {"bottom", Wall{}},
                                {"top", Wall{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  EnergyBalance energy(solver);
  for (int i = 0; i < 60; ++i) {
    solver.step(0.01);
    energy.add(solver, 0.01);
  }
  EXPECT_LE(energy.part_made(), 1e-3);
  EXPECT_LE(std::abs(energy.work()), 1);
}

// A flow that hardly moves a stiff disc stores less than rounding leaves of the energy of a disc at
// rest. This is no energy from nothing.
TEST(EnergyBalance, RoundingMakesNoEnergy) {
  for (const Real force : {0.0, 1e-20, 1e-10}) {
    const Mesh mesh =
        test::read_box({.n = {32, 16, 0}, .length = {2, 1, 1}, .periodic = {"left", "right"}});
    Solver solver(
        mesh, {.rho = 1, .mu_f = 0.1},
        {.conditions = {{"top", Wall{}}, {"bottom", Wall{}}}, .body_force = [=](const Vec3&, Real) {
           return Vec3{force, 0, 0};
         }});
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid(
        {.shape = shapes::translate(shapes::sphere(0.2), {1, 0.5, 0}), .G = 10, .mu = 0.1});
    EnergyBalance energy(solver);
    for (int i = 0; i < 100; ++i) {
      const Real dt = solver.advance(std::min(0.01, solver.elastic_dt()));
      ASSERT_GT(dt, 0);
      energy.add(solver, dt);
    }
    std::printf("force %g: made %.2e, work %.2e\n", force, energy.made(), energy.work());
    EXPECT_LE(energy.part_made(), 0.01) << force;
  }
}

// A stiff disc makes no energy at the steps that the solver allows; at steps 2.5 times as long it
// makes it from nothing, and the balance tells.
TEST(EnergyBalance, ToldOfAStiffSolidInTooLongSteps) {
  const auto made = [](Real G, Real longer) {
    const Mesh mesh = test::read_box({.n = {32, 32, 0}});
    Solver solver(
        mesh, {.rho = 1, .mu_f = 0.01},
        {.conditions = {
             {"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}, {"top", Wall{{1, 0, 0}}}}});
    solver.start([](const Vec3&) { return Vec3{}; });
    solver.put_solid(
        {.shape = shapes::translate(shapes::sphere(0.2), {0.6, 0.5, 0}), .G = G, .mu = 0.01});
    EnergyBalance energy(solver);
    for (int i = 0; i < 150; ++i) {
      const Real dt = std::min(
          {solver.advective_dt(0.5), longer * solver.elastic_dt(), solver.boundary_dt(0.5)});
      solver.step(dt);
      energy.add(solver, dt);
    }
    return energy.part_made();
  };
  EXPECT_LE(made(0.1, 1), 0.05);
  EXPECT_LE(made(1e3, 1), 1e-3);
  EXPECT_GE(made(1e3, 2.5), 0.3);
}

/// A layer of solid between a wall at rest and one that moves by cos(2 pi t), for ten periods: work
/// over the elastic energy at full stretch, and the part that was made.
std::array<Real, 2> work_on_a_layer(int steps) {
  constexpr Real G = 10, mu = 0.02, rho = 0.1, omega = 2 * std::numbers::pi;
  const Mesh mesh =
      test::read_box({.n = {4, 8, 0}, .length = {0.25, 1, 1}, .periodic = {"left", "right"}});
  const FixedVelocity wall{[](const Vec3&, Real t) {
    return Vec3{std::cos(2 * std::numbers::pi * t), 0, 0};
  }};
  Solver solver(mesh, {.rho = rho, .mu_f = mu},
                {.conditions = {{"bottom", Wall{}}, {"top", wall}}});
  solver.start([](const Vec3& x) { return Vec3{x.y, 0, 0}; });
  solver.put_solid({.shape = shapes::translate(shapes::box({200, 1, 200}), {0, 0.5, 0}),
                    .G = G,
                    .mu = mu,
                    .rho = rho});
  EnergyBalance energy(solver);
  const Real dt = 1.0 / steps;
  for (int i = 0; i < 10 * steps; ++i) {
    solver.step(dt);
    energy.add(solver, dt);
  }
  return {energy.work() / (mesh.total_volume * G / 2 / (omega * omega)), energy.part_made()};
}

// Stress belongs to the middle of a step and the velocity to its end. Paired as they are, they
// would lose pi w dt of the energy in a period, here 2 and 1 of it in ten.
TEST(EnergyBalance, TheWorkOnALayerDoesNotDependOnTheStep) {
  const auto [coarse, made_coarse] = work_on_a_layer(100);
  const auto [fine, made_fine] = work_on_a_layer(200);
  std::printf("layer: work %.3f, %.3f of its energy, made %.1e, %.1e\n", coarse, fine, made_coarse,
              made_fine);
  EXPECT_NEAR(coarse, fine, 0.01);
  EXPECT_LE(made_coarse, 1e-3);
  EXPECT_LE(made_fine, 1e-3);
}

}  // namespace
}  // namespace fsi
