// Walls that move.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/energy.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// A box whose top has waves of that height.
Mesh wavy(Real height) {
  return test::read_box({.n = {16, 16, 0}, .moved = [height](const Vec3& x) {
                           return x + Vec3{0, height * x.y * std::sin(6 * x.x), 0};
                         }});
}

Conditions lid(const Vec3& velocity) {
  return {{"top", Wall{velocity}}, {"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}};
}

std::string complaint(const Mesh& mesh, const Conditions& conditions) {
  try {
    resolve(conditions, mesh);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
  return "";
}

TEST(Walls, MayNotMoveThroughThemselves) {
  EXPECT_EQ(complaint(wavy(0), lid({1, 0, 0})), "");
  EXPECT_EQ(complaint(wavy(0.1), lid({})), "");
  EXPECT_NE(complaint(wavy(0.1), lid({1, 0, 0})).find("\"top\" moves through itself"),
            std::string::npos);
  EXPECT_NE(complaint(wavy(0), lid({1, -0.5, 0})).find("\"top\" moves through itself"),
            std::string::npos);
}

TEST(Walls, AndVelocitiesStayInThePlane) {
  const std::string of_wall = complaint(wavy(0), lid({1, 0, 0.5}));
  EXPECT_NE(of_wall.find("\"top\" has a part along z"), std::string::npos) << of_wall;
}

// A block with corners. Where its last cell has a slanted plane, that plane may reach the floor.
TEST(Walls, HoldASolidThatCoversThemAndNoOther) {
  const Mesh mesh = test::read_box({.n = {24, 24, 0}});
  const auto bonded = [&](Real gap) {
    Solver solver(mesh, {.rho = 1, .mu_f = 0.1}, {.conditions = lid({})});
    solver.start([](const Vec3&) { return Vec3{}; });
    const Vec3 at{0.4364583, 0.15 + gap / 24, 0};
    solver.put_solid(
        {.shape = shapes::translate(shapes::box({0.20625, 0.3, 9}), at), .G = 1, .mu = 0.1});
    return solver.body()->bonded_faces;
  };
  EXPECT_EQ(bonded(0), 5);
  for (const Real gap : {0.02, 0.1, 0.2}) EXPECT_EQ(bonded(gap), 0) << gap;
}

// What is left of a plane in a mesh file's digits must not become a flux that no outflow takes up.
TEST(Walls, LetNothingThrough) {
  const Mesh mesh = wavy(1e-7);
  Solver solver(mesh, {}, {.conditions = lid({1, 0, 0})});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (int i = 0; i < 5; ++i) solver.step(0.02);
  Real through = 0;
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
    through = std::max(through, std::abs(solver.state().phi[f]) / norm(mesh.Sf[f]));
  EXPECT_LE(global_max(through), 1e-15);
  EXPECT_LE(flow::divergence_max(solver.state().phi, mesh), 1e-7);
}

// The stand-in for elasticity sees how a wall's velocity changes: stiff enough, a solid that fills
// the box follows its walls within the step.
TEST(Walls, CarryAStiffSolidWithThem) {
  const Mesh mesh = test::read_box({.n = {8, 8, 0}, .periodic = {"left", "right"}});
  const FaceWeights weights(mesh);
  const Conditions conditions{{"top", Wall{}}, {"bottom", Wall{}}};
  flow::Momentum momentum(mesh, weights, resolve(conditions, mesh), 1, 0.01);
  CellField<Vec3> u(mesh);
  const CellField<Vec3> none(mesh);
  const CellField<Tensor> L(mesh);
  const FaceField<Real> phi(mesh), mu(mesh, 0.01), kappa(mesh, 1e3);
  const BoundaryField<Vec3> before(mesh), after(mesh, {0.1, 0, 0});
  momentum.predict(u,
                   {.u_b = before,
                    .u_b_new = after,
                    .grad_p = none,
                    .L = L,
                    .L_f = {},
                    .phi = phi,
                    .mu = mu,
                    .kappa = kappa,
                    .stiff = true,
                    .force = none},
                   0.1);
  for (Index c = 0; c < mesh.n_owned; ++c) EXPECT_NEAR(u[c].x, 0.1, 1e-3);
}

// A solid that fills a box but for a film at one side, another being open: it touches the two left.
TEST(Walls, AreTouchedByTheSolidAtThem) {
  constexpr Index n = 16;
  const Mesh mesh = test::read_box({.n = {n, n, 0}});
  const FaceWeights weights(mesh);
  constexpr Real film = 0.3 / n;
  const auto layer = shapes::translate(shapes::box({200, 2 - 2 * film, 200}), {0, 0, 0});
  Body body(mesh, weights, {.shape = layer, .G = 1}, {});
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_owned; ++c) cells.push_back(c);
  std::vector<char> open(static_cast<std::size_t>(mesh.n_boundary()), 0);
  const auto b_of = [&](Index f) { return static_cast<std::size_t>(f - mesh.n_internal); };
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
    if (mesh.Cf[f].x > 1 - 1e-9) open[b_of(f)] = 1;
  body.set_touched(cells, open);
  int touched = 0;
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
    if (mesh.owner[f] >= mesh.n_owned) continue;
    const Vec3& x = mesh.Cf[f];
    const bool solid = x.y < 1 - film, opening = open[b_of(f)] != 0;
    EXPECT_EQ(body.touched[f - mesh.n_internal] != 0, solid && !opening) << x.x << " " << x.y;
    touched += body.touched[f - mesh.n_internal];
  }
  EXPECT_GT(touched, 0);
}

// A layer on the floor that has come there: two cells thick, those at the floor leave their strain
// to the ones above; thinner, they are all that knows it and keep it. A layer that is bonded keeps
// it too.
TEST(Walls, LeaveTheStrainToTheCellsFartherIn) {
  constexpr Index n = 6;
  struct Layer {
    Real height;  // in cells
    bool bonded, simplex;
  };
  for (const Layer layer :
       {Layer{2, false, true}, Layer{2, false, false}, Layer{0.5, false, true},
        Layer{0.5, false, false}, Layer{2, true, true}, Layer{2, true, false}}) {
    const Mesh mesh = test::read_box(
        {.n = {n, n, n}, .simplex = layer.simplex, .periodic = {"left", "right", "back", "front"}});
    CellField<Real> alpha(mesh);
    std::vector<char> bonded(static_cast<std::size_t>(mesh.n_boundary()), 0);
    for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
      bonded[f - mesh.n_internal] = layer.bonded && mesh.Cf[f].y < 1e-9;
    solid::WallFilm film(mesh, {mesh.patch("bottom")}, bonded);
    for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
      EXPECT_EQ(film.faces()[static_cast<std::size_t>(f - mesh.n_internal)] != 0,
                mesh.Cf[f].y < 1e-9 && !layer.bonded);
    const auto solid = [&](Index c) { return mesh.C[c].y < layer.height / n; };
    for (Index c = 0; c < mesh.n_cells; ++c) alpha[c] = solid(c) ? 1 : 0;
    film.set(alpha);
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const bool left = layer.height > 1 && film.at_film(c);
      EXPECT_EQ(film.fraction()[c], solid(c) && !left ? 1 : 0) << mesh.C[c].y * n;
    }
  }
}

// A film that is a fifth of the way from the wall to the centre of its cell, and one that is asked
// for.
TEST(Walls, FilmsBearTheVelocityAcrossThem) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}});
  std::vector<char> bonded(static_cast<std::size_t>(mesh.n_boundary()), 0);
  const solid::WallFilm film(mesh, {mesh.patch("bottom")}, bonded);
  CellField<Real> alpha(mesh);
  FaceField<Real> alpha_f(mesh), mu(mesh);
  alpha.fill(0.9), alpha_f.fill(0.8), mu.fill(7);
  const Real d = 0.5 / 4, mu_f = 2;
  for (const Real thickness : {Real{0}, 0.1 * d, 0.5 * d, 2 * d}) {
    film.set_viscosity(mu, alpha, mu_f);
    if (thickness > 0)
      film.thin(mu, alpha, alpha_f, mu_f), film.bound_viscosity(mu, alpha, mu_f, thickness);
    const Real between = thickness > 0 ? std::max(0.2 * d, thickness) : d;
    for (Index f = 0; f < mesh.n_faces; ++f)
      EXPECT_NEAR(mu[f], mesh.Cf[f].y < 1e-9 ? mu_f * d / between : 7, 1e-12);
  }
}

// The friction of flat walls has an explicit part, in the corner of a duct two of them.
TEST(Walls, FrictionIsStableAtAnyViscosity) {
  for (const Index n : {1, 2, 3})
    for (const Real mu : {0.01, 100.0, 1e5}) {
      const Mesh mesh = test::read_box({.n = {8, n, n}, .length = {2, 1, 1}});
      const FlowRate inflow{[](Real) { return 0.5; }, InflowProfile::plug};
      Solver solver(mesh, {.rho = 1, .mu_f = mu},
                    {.conditions = {{"left", inflow},
                                    {"right", Opening{0}},
                                    {"bottom", Wall{}},
                                    {"top", Wall{}},
                                    {"back", Wall{}},
                                    {"front", Wall{}}}});
      solver.start([](const Vec3&) { return Vec3{}; });
      for (int i = 0; i < 60; ++i) solver.step(0.05);
      Real fastest = 0;
      for (Index c = 0; c < mesh.n_owned; ++c)
        fastest = std::max(fastest, norm(solver.state().u[c]));
      EXPECT_LT(global_max(fastest), 2) << n << " cells across, mu " << mu;
    }
}

// What is explicit of the friction is extrapolated in part. A steady flow stays as it is whatever
// the lengths of the steps.
TEST(Walls, FrictionOfASteadyFlowIsThatOfAnyStep) {
  const Mesh mesh =
      test::read_box({.n = {4, 16, 0}, .length = {0.25, 1, 1}, .periodic = {"left", "right"}});
  constexpr Real mu = 1, f = 12 * mu, dt = 0.01;  // mean velocity 1
  Solver solver(
      mesh, {.rho = 1, .mu_f = mu},
      {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}, .body_force = [](const Vec3&, Real) {
         return Vec3{f, 0, 0};
       }});
  solver.start([](const Vec3& x) { return Vec3{6 * x.y * (1 - x.y), 0, 0}; });
  for (int i = 0; i < 400; ++i) solver.step(dt);
  const Real before = solver.mean_velocity();
  Real most = 0;
  for (const Real part : {1.0, 0.5, 0.5, 1.0, 0.1, 0.1, 1.0, 1.0}) {
    solver.step(part * dt);
    most = std::max(most, std::abs(solver.mean_velocity() / before - 1));
  }
  EXPECT_LE(most, 1e-7);
}

/// A layer of solid between a wall at rest and one that slides to and fro, with a disturbance of
/// 1e-6: the largest u_y in it at the end, and the part of the energy that was made.
std::array<Real, 2> disturbed_layer(bool simplex) {
  constexpr Index n = 16;
  constexpr Real G = 10, mu = 0.02, rho = 0.1, a = 0.1, dt = 2.5e-3;
  const Mesh mesh = test::read_box({.n = {4, n, 0},
                                    .length = {4.0 / n, 1, 1},
                                    .simplex = simplex,
                                    .periodic = {"left", "right"}});
  const FixedVelocity wall{[](const Vec3&, Real t) {
    return Vec3{a * std::cos(2 * std::numbers::pi * t), 0, 0};
  }};
  Solver solver(mesh, {.rho = rho, .mu_f = mu},
                {.conditions = {{"bottom", Wall{}}, {"top", wall}}});
  solver.start([](const Vec3& x) {
    return Vec3{a * x.y + 1e-6 * std::sin(1e4 * x.x + 1e3 * x.y), 1e-6 * std::cos(2e4 * x.x), 0};
  });
  solver.put_solid({.shape = shapes::translate(shapes::box({200, 1, 200}), {0, 0.5, 0}),
                    .G = G,
                    .mu = mu,
                    .rho = rho});
  EnergyBalance energy(solver);
  for (int i = 0; i < 1600; ++i) {
    solver.step(dt);
    energy.add(solver, dt);
  }
  Real most = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) most = std::max(most, std::abs(solver.state().u[c].y));
  return {global_max(most), energy.part_made()};
}

// Waves along a wall must not feed on the one-sided gradient of the map there.
TEST(Walls, ALayerBetweenThemStaysUniform) {
  for (const bool simplex : {false, true}) {
    const auto [spread, made] = disturbed_layer(simplex);
    EXPECT_LE(spread, 1e-5) << simplex;
    EXPECT_LE(made, 1e-3) << simplex;
  }
}

/// A layer is bonded to a wall at rest below a fluid that a force 1 drives: elastic energy over the
/// exact one, and mean velocity of the layer, at the end.
std::array<Real, 2> loaded_layer(Index n, bool simplex, KinematicsKind kinematics, Real end,
                                 Real mu_s = 0.2) {
  const Real length = 4.0 / static_cast<Real>(n);
  const Mesh mesh = test::read_box({.n = {4, n, 0},
                                    .length = {length, 1, 1},
                                    .simplex = simplex,
                                    .periodic = {"left", "right"}});
  Solver solver(
      mesh, {.rho = 1, .mu_f = 0.2},
      {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}, .body_force = [](const Vec3&, Real) {
         return Vec3{1, 0, 0};
       }});
  solver.start([](const Vec3&) { return Vec3{}; });
  solver.put_solid({.shape = shapes::translate(shapes::box({200, 0.5, 200}), {0, 0.25, 0}),
                    .G = 2,
                    .mu = mu_s,
                    .kinematics = kinematics});
  while (solver.state().t < end) {
    const Real dt = std::min({0.05, solver.advective_dt(0.5), solver.elastic_dt()});
    EXPECT_GT(solver.advance(dt), 0) << solver.report().failure;
    if (!solver.report().failure.empty()) break;
  }
  Sum moved, volume;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real V = mesh.V[c] * solver.body()->alpha[c];
    moved.add(V * solver.state().u[c].x), volume.add(V);
  }
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (mesh.C[c].y < 0.3) {
      EXPECT_EQ(solver.body()->alpha[c], 1);
    }
  }
  // shear (3/4 - y) / G, y from 0 to 1/2
  const Real exact = (27.0 - 1) / 64 / 3 / (2 * 2) * length;
  return {elastic_energy(*solver.body()) / exact, moved.total() / volume.total()};
}

// The map of a layer that is bonded to a wall at rest stays zero there. Without that nothing holds
// the map at the wall, and psi, drawn to it, lets the layer slide.
// A layer on the floor, and one of twice the height that the floor cuts.
TEST(Walls, TheMeshCutsASolidThatIsToBeTrimmed) {
  const Mesh mesh = test::read_box({.n = {6, 12, 0}, .periodic = {"left", "right"}});
  std::vector<Vec3> u[2];
  for (const bool trim : {false, true}) {
    Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                  {.conditions = {{"bottom", Wall{}}, {"top", Wall{{1, 0, 0}}}}});
    solver.start([](const Vec3&) { return Vec3{}; });
    const shapes::Shape box = shapes::box({9, trim ? 0.7 : 0.35, 9});
    Solid solid{.shape = shapes::translate(box, {0, trim ? 0 : 0.175, 0}), .G = 1, .mu = 0.1};
    if (trim) {
      EXPECT_THROW(solver.put_solid(solid), Error);
    }
    solid.trim = trim;
    solver.put_solid(solid);
    EXPECT_EQ(solver.body()->bonded_faces, 6);
    EXPECT_NEAR(solver.body()->filled.volume, 0.35, 1e-9);
    for (int i = 0; i < 20; ++i) solver.step(0.02);
    for (Index c = 0; c < mesh.n_owned; ++c) u[trim ? 1 : 0].push_back(solver.state().u[c]);
  }
  for (std::size_t c = 0; c < u[0].size(); ++c) EXPECT_LT(norm(u[0][c] - u[1][c]), 1e-7);
}

TEST(Walls, ALayerOnOneBearsALastingLoad) {
  struct Scene {
    Index n;
    bool simplex;
    KinematicsKind kinematics;
  };
  for (const auto& [n, simplex, kinematics] : {Scene{16, false, KinematicsKind::reference_map},
                                               Scene{16, false, KinematicsKind::log_conformation},
                                               Scene{12, true, KinematicsKind::log_conformation}}) {
    const auto [energy, speed] = loaded_layer(n, simplex, kinematics, 30);
    std::printf("layer on a wall, %s, %d: elastic energy over the exact one %.4f, speed %.1e\n",
                simplex ? "triangles" : "quads", static_cast<int>(kinematics), energy, speed);
    EXPECT_NEAR(energy, 1, 0.03);
    EXPECT_LE(std::abs(speed), 1e-3);
  }
}

// Where the viscosity is large, the memory of a layer of triangles must lose what alternates as
// fast as psi is drawn to it. Else both feed each other at the wall.
TEST(Walls, AViscousLayerOnOneComesToRest) {
  std::array<Real, 2> energy{};
  for (const int i : {0, 1}) {
    const auto [stored, speed] =
        loaded_layer(12, true, KinematicsKind::log_conformation, i == 0 ? 30 : 60, 2);
    std::printf("viscous layer on a wall: elastic energy over the exact one %.4f, speed %.1e\n",
                stored, speed);
    energy[i] = stored;
  }
  EXPECT_NEAR(energy[0], 1, 0.2);
  EXPECT_NEAR(energy[1], energy[0], 1e-3);
}

}  // namespace
}  // namespace fsi
