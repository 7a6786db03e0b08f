// Several solids in one flow.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/solver/energy.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

Solid disc(const std::string& name, const Vec3& centre, Real G, Real mu = 0.1) {
  return {.shape = shapes::translate(shapes::sphere(0.15), centre), .G = G, .mu = mu, .name = name};
}

struct Place {
  Real volume;
  Vec3 centre;
};
Place place(const Body& body) {
  std::array<Sum, 4> sums;
  for (Index c = 0; c < body.mesh.n_owned; ++c) {
    const Real V = body.mesh.V[c] * body.alpha[c];
    sums[0].add(V);
    for (int i = 0; i < 3; ++i) sums[i + 1].add(V * body.mesh.C[c][i]);
  }
  std::array<Real, 4> total{};
  Sum::totals(total, sums);
  return {total[0], Vec3{total[1], total[2], total[3]} / total[0]};
}

struct Scene {
  explicit Scene(bool simplex)
      : mesh(test::read_box({.n = {40, 32, 0},
                             .length = {1.25, 1, 1},
                             .simplex = simplex,
                             .periodic = {"left", "right"}})),
        solver(mesh, {.rho = 1, .mu_f = 0.1},
               {.conditions = {{"top", Wall{{0.5, 0, 0}}}, {"bottom", Wall{{-0.5, 0, 0}}}}}) {
    solver.start([](const Vec3& x) { return Vec3{x.y - 0.5, 0, 0}; });
  }
  const Mesh mesh;
  Solver solver;
};

// What a step makes of two discs that are almost in touch does not depend on which was put in
// first. They have one, two and no one-sided gradients, traction and film in common cells.
TEST(Bodies, TheirOrderDoesNotMatter) {
  for (const bool simplex : {false, true})
    for (const Vec3& mu : {Vec3{0.1, 0.1, 0}, Vec3{0.02, 0.05, 0}, Vec3{0.1, 0.4, 0}}) {
      const Mesh mesh = test::read_box({.n = {24, 12, 0}, .length = {2, 1, 1}, .simplex = simplex});
      std::vector<Vec3> u[2];
      for (const bool swapped : {false, true}) {
        Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                      {.conditions = {{"left", Wall{}},
                                      {"right", Wall{}},
                                      {"top", Wall{{1, 0, 0}}},
                                      {"bottom", Wall{{-1, 0, 0}}}}});
        solver.start([](const Vec3& x) { return Vec3{2 * x.y - 1, 0, 0}; });
        Solid one = disc("one", {0.83, 0.31, 0}, 1, mu.x),
              two = disc("two", {1.15, 0.26, 0}, 2, mu.y);
        two.shape = shapes::translate(shapes::sphere(0.17), {1.15, 0.26, 0});
        one.film_thickness = two.film_thickness = 0.01;
        solver.put_solid(swapped ? two : one), solver.put_solid(swapped ? one : two);
        for (int i = 0; i < 12; ++i) solver.step(0.01);
        for (Index c = 0; c < mesh.n_owned; ++c) u[swapped ? 1 : 0].push_back(solver.state().u[c]);
      }
      Real most = 0;
      for (std::size_t c = 0; c < u[0].size(); ++c) most = std::max(most, norm(u[1][c] - u[0][c]));
      EXPECT_LT(global_max(most), 1e-8) << simplex << ' ' << mu.x << ' ' << mu.y;
    }
}

// A step that failed between the two solids leaves nothing to the next one.
TEST(Bodies, AFailedStepLeavesNoGradients) {
  Scene scene(true);
  scene.solver.put_solid(disc("one", {0.5, 0.5, 0}, 1));
  scene.solver.put_solid(disc("two", {0.8, 0.5, 0}, 1));
  const std::deque<Body>& bodies = scene.solver.bodies();
  const auto same = [](Real a) { return Tensor{a, a, a, a, a, a, a, a, a}; };
  CellField<Tensor> flow(scene.mesh),
      L[2]{CellField<Tensor>(scene.mesh), CellField<Tensor>(scene.mesh)};
  SideGradients failed(scene.mesh), fresh(scene.mesh);
  failed.begin(flow);
  L[0].fill(same(5));
  failed.keep(L[0], bodies[0]);
  for (SideGradients* one : {&failed, &fresh}) {
    CellField<Tensor>& of = L[one == &failed ? 0 : 1];
    one->begin(flow);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      of.fill(same(1 + static_cast<Real>(i)));
      one->keep(of, bodies[i]);
      of.assign(flow);
    }
    one->merge(of, bodies);
  }
  Real most = 0, largest = 0;
  for (Index c = 0; c < scene.mesh.n_owned; ++c) {
    most = std::max(most, std::abs(L[0][c].xx - L[1][c].xx));
    largest = std::max(largest, L[1][c].xx);
  }
  EXPECT_EQ(global_max(most), 0);
  EXPECT_EQ(global_max(largest), 2);
}

// Two discs in shear are pressed together and roll over each other: they stay two, each keeps its
// volume, and as the scene is its own image under a half turn, so are they.
TEST(Bodies, PassEachOtherAndKeepTheirVolumes) {
  for (const bool simplex : {false, true}) {
    Scene scene(simplex);
    scene.solver.put_solid(disc("one", {0.4, 0.56, 0}, 2));
    scene.solver.put_solid(disc("two", {0.85, 0.44, 0}, 2));
    const Place one = place(scene.solver.bodies()[0]), two = place(scene.solver.bodies()[1]);
    while (scene.solver.state().t < 5)
      ASSERT_GT(scene.solver.advance(std::min(0.02, scene.solver.elastic_dt())), 0);
    const Place a = place(scene.solver.bodies()[0]), b = place(scene.solver.bodies()[1]);
    EXPECT_NEAR(a.volume / one.volume, 1, 1e-12);
    EXPECT_NEAR(b.volume / two.volume, 1, 1e-12);
    EXPECT_GT(a.centre.x, b.centre.x);  // they have passed
    EXPECT_LE(scene.solver.overlap(), 1e-3);
    if (simplex) continue;
    EXPECT_NEAR(a.centre.x + b.centre.x, 1.25, 1e-6);
    EXPECT_NEAR(a.centre.y + b.centre.y, 1, 1e-6);
  }
}

/// Kinetic energy at t = 1 of a channel whose lower wall starts to move. Slabs of that viscosity,
/// ten times the fluid's, lie one upon the other between these heights.
Real energy_of_slabs(const std::vector<Real>& heights, Real mu) {
  const Mesh mesh =
      test::read_box({.n = {4, 32, 0}, .length = {0.125, 1, 1}, .periodic = {"left", "right"}});
  Solver solver(mesh, {.rho = 1, .mu_f = 0.01},
                {.conditions = {{"top", Wall{}}, {"bottom", Wall{{1, 0, 0}}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (std::size_t i = 0; i + 1 < heights.size(); ++i)
    solver.put_solid({.shape = shapes::translate(shapes::box({40, heights[i + 1] - heights[i], 40}),
                                                 {0, (heights[i] + heights[i + 1]) / 2, 0}),
                      .G = 1,
                      .mu = mu,
                      .name = "slab" + std::to_string(i)});
  while (solver.state().t < 1)
    if (!(solver.advance(std::min(0.01, solver.elastic_dt())) > 0)) return 0;
  return kinetic_energy(solver);
}

// Two slabs that lie on each other bear one traction, as one slab does.
TEST(Bodies, TwoSlabsOfAnotherViscosityMoveAsOne) {
  for (const Real mu : {0.002, 0.03, 0.1}) {
    const Real one = energy_of_slabs({0.285, 0.715}, mu),
               two = energy_of_slabs({0.285, 0.507, 0.715}, mu);
    std::printf("mu_s = %g: kinetic energy of two slabs over that of one %.5f\n", mu, two / one);
    EXPECT_NEAR(two / one, 1, 0.002);
  }
}

// B alone does not tell a map, and psi does not follow from one.
TEST(Bodies, EachKinematicsTakesItsOwnFieldAlone) {
  Scene scene(false);
  Solid solid = disc("one", {0.3, 0.5, 0}, 2);
  solid.kinematics = KinematicsKind::reference_map;
  scene.solver.put_solid(solid);
  scene.solver.put_solid(disc("two", {0.9, 0.5, 0}, 2));
  EXPECT_THROW(scene.solver.bodies()[0].set_B([](const Vec3&) { return identity(); }), Error);
  EXPECT_THROW(scene.solver.bodies()[1].set_map([](const Vec3& x) { return x; }), Error);
}

// A second solid of the fluid's own stuff changes nothing but by what its interface costs.
TEST(Bodies, OneOfFluidIsNotFelt) {
  Scene alone(false), both(false);
  alone.solver.put_solid(disc("", {0.4, 0.56, 0}, 2));
  both.solver.put_solid(disc("soft", {0.4, 0.56, 0}, 2));
  both.solver.put_solid(disc("none", {0.85, 0.44, 0}, 0));
  for (int i = 0; i < 50; ++i) {
    alone.solver.step(0.02);
    both.solver.step(0.02);
  }
  const Vec3 apart = place(alone.solver.bodies()[0]).centre - place(both.solver.bodies()[0]).centre;
  EXPECT_LE(norm(apart), 1e-10);
}

TEST(Bodies, ViscositiesMixByTheirFractions) {
  Scene scene(false);
  scene.solver.put_solid(disc("thick", {0.4, 0.5, 0}, 1, 0.15));
  scene.solver.put_solid(disc("thin", {0.85, 0.5, 0}, 1, 0.06));
  for (int i = 0; i < 20; ++i) ASSERT_GT(scene.solver.advance(0.02), 0);
  const auto in_the_middle_of = [&](const Body& body) {
    Index nearest = 0;
    const Vec3 centre = place(body).centre;
    for (Index f = 0; f < scene.mesh.n_internal; ++f)
      if (norm(scene.mesh.Cf[f] - centre) < norm(scene.mesh.Cf[nearest] - centre)) nearest = f;
    return scene.solver.mu()[nearest];
  };
  if (ranks() > 1) return;  // a face of the whole mesh is looked for
  EXPECT_NEAR(in_the_middle_of(scene.solver.bodies()[0]), 0.15, 1e-12);
  EXPECT_NEAR(in_the_middle_of(scene.solver.bodies()[1]), 0.06, 1e-12);
}

TEST(Bodies, RefusesASecondOfTheSameNameOrPlace) {
  const auto sentence = [](const Solid& second) {
    Scene scene(false);
    scene.solver.put_solid(disc("one", {0.4, 0.5, 0}, 1));
    try {
      scene.solver.put_solid(second);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(sentence(disc("one", {0.8, 0.5, 0}, 1)), "two solids have the name \"one\"");
  EXPECT_EQ(sentence(disc("two", {0.5, 0.5, 0}, 1)),
            "solid \"two\" overlaps solid \"one\" at the start: move one of them");
  EXPECT_EQ(sentence(disc("two", {0.8, 0.5, 0}, 1)), "");
}

/// What the call throws as bad input; "" where nothing.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
    return error.what();
  }
  return "";
}

TEST(Bodies, RefusesAMaterialOutOfBounds) {
  const auto sentence = [](Real G, Real mu, Real rho) {
    Scene scene(false);
    Solid solid = disc("one", {0.4, 0.5, 0}, 1);
    solid.G = G, solid.rho = rho;
    solid.mu = mu * scene.solver.physics().mu_f;
    return refusal([&] { scene.solver.put_solid(solid); });
  };
  EXPECT_EQ(sentence(1, 1, 0), "");
  EXPECT_EQ(sentence(0, 0, 2), "");
  EXPECT_EQ(sentence(-1, 1, 0), "solid \"one\": G is -1 and must be a number >= 0");
  EXPECT_NE(sentence(std::nan(""), 1, 0).find("G is nan"), std::string::npos);
  EXPECT_NE(sentence(1, -1, 0).find("must be a number >= 0"), std::string::npos);
  EXPECT_NE(sentence(1, 201, 0).find("at most 200 times"), std::string::npos);
  EXPECT_NE(sentence(1, 1, -3).find("rho is -3 and must be 0.1 to 20 times"), std::string::npos);
  EXPECT_NE(sentence(1, 1, 500).find("rho is 500"), std::string::npos);
}

TEST(Bodies, RefusesOneLayerOfCellsBetweenPlanesOfSymmetry) {
  const auto sentence = [](Index layers) {
    const Mesh mesh = test::read_box({.n = {8, 8, layers}, .length = {1, 1, 0.25}});
    Conditions conditions{{"left", Wall{}}, {"right", Wall{}}, {"bottom", Wall{}}, {"top", Wall{}}};
    conditions["back"] = conditions["front"] = Slip{};
    Solver solver(mesh, {}, {.conditions = conditions});
    return refusal([&] {
      solver.put_solid(
          {.shape = shapes::translate(shapes::sphere(0.3), {0.5, 0.5, 0}), .G = 1, .mu = 1});
    });
  };
  EXPECT_EQ(sentence(2), "");
  EXPECT_NE(sentence(1).find("one layer of cells is too thin"), std::string::npos);
}

TEST(Bodies, OneThatIsRefusedIsNotThere) {
  Scene scene(false), other(false);
  for (Scene* one : {&scene, &other}) one->solver.put_solid(disc("one", {0.4, 0.5, 0}, 1));
  for (const Solid& bad : {disc("two", {0.5, 0.5, 0}, 1), disc("one", {0.8, 0.5, 0}, 1),
                           disc("two", {0.8, 0.1, 0}, 1), disc("two", {0.8, 5, 0}, 1)}) {
    EXPECT_NE(refusal([&] { scene.solver.put_solid(bad); }), "");
    EXPECT_EQ(scene.solver.bodies().size(), 1U);
  }
  for (Scene* one : {&scene, &other}) {
    one->solver.put_solid(disc("two", {0.8, 0.5, 0}, 1));
    ASSERT_EQ(one->solver.advance(0.02), 0.02);
  }
  for (Index c = 0; c < scene.mesh.n_owned; ++c)
    ASSERT_EQ(norm(scene.solver.state().u[c] - other.solver.state().u[c]), 0);
}

TEST(Bodies, NoneIsTakenOut) {
  Scene scene(false);
  scene.solver.put_solid(disc("one", {0.4, 0.5, 0}, 1));
  ASSERT_EQ(scene.solver.advance(0.02), 0.02);
  scene.solver.bodies().clear();
  for (const std::string& said : {refusal([&] { scene.solver.advance(0.02); }),
                                  refusal([&] { scene.solver.step(0.02); }), refusal([&] {
                                    scene.solver.put_solid(disc("two", {0.8, 0.5, 0}, 1));
                                  })})
    EXPECT_NE(said.find("none is taken out"), std::string::npos) << said;
}

// Into a flow that goes on for ever a disc is put that weighs or rubs more than the fluid. What it
// changes in two steps is felt beside it, not at the walls.
TEST(Bodies, OneThatIsPutInLaterPushesWhatIsBesideIt) {
  for (const bool simplex : {false, true})
    for (const auto& [mu, rho] : {std::array{0.1, 1.0}, {0.15, 1.0}, {1.0, 1.0}, {0.1, 3.0}}) {
      Scene scene(simplex);
      Solver& solver = scene.solver;
      for (int i = 0; i < 5; ++i) ASSERT_EQ(solver.advance(0.005), 0.005);
      Solid later = disc("later", {0.6, 0.5, 0}, 1, mu);
      later.rho = rho;
      solver.put_solid(later);
      const Real volume = place(solver.bodies()[0]).volume;
      for (int i = 0; i < 2; ++i) ASSERT_EQ(solver.advance(0.005), 0.005);
      Real off = 0;
      for (Index c = 0; c < scene.mesh.n_owned; ++c) {
        const Vec3& x = scene.mesh.C[c];
        if (std::abs(x.y - 0.5) > 0.45)
          off = std::max(off, norm(solver.state().u[c] - Vec3{x.y - 0.5, 0, 0}));
      }
      EXPECT_LE(global_max(off), 5e-3) << mu << " " << rho << " " << simplex;
      for (int i = 0; i < 100; ++i)
        ASSERT_GT(solver.advance(std::min(0.01, solver.elastic_dt())), 0)
            << solver.report().failure;
      const Place end = place(solver.bodies()[0]);
      EXPECT_NEAR(end.volume / volume, 1, 1e-12);
      EXPECT_LE(norm(end.centre - Vec3{0.6, 0.5, 0}), 0.01);  // in the middle of the shear
    }
}

// A crumb torn off a disc, one cell with the map of a place at the surface, does not take volume
// from the disc and grow to a second one, but goes back to it. So does a wisp where there is no
// map. A solid that is in pieces from the start keeps them, also one as small as a crumb.
TEST(Bodies, TakeBackACrumb) {
  for (const bool simplex : {false, true}) {
    const Mesh mesh = test::read_box({.n = {40, 40, 0}, .simplex = simplex});
    const FaceWeights weights(mesh);
    const auto right = [&](const Body& body) {
      Sum sum;
      for (Index c = 0; c < mesh.n_owned; ++c)
        if (mesh.C[c].x > 0.55) sum.add(mesh.V[c] * body.alpha[c]);
      return sum.total();
    };
    const shapes::Shape one = shapes::translate(shapes::sphere(0.2), {0.3, 0.5, 0});
    Body torn(mesh, weights, {.shape = one, .G = 1}, {});
    for (Index c = 0; c < mesh.n_cells; ++c)
      if (norm(mesh.C[c] - Vec3{0.76, 0.51, 0}) < 0.01) {
        torn.alpha[c] = 1;
        torn.memory->set_map(c, mesh.C[c] - Vec3{0.27, 0, 0});
      }
    torn.resume();
    const auto wisp = [](const Vec3& x) { return norm(x - Vec3{0.91, 0.11, 0}) < 0.01; };
    for (Index c = 0; c < mesh.n_cells; ++c)
      if (wisp(mesh.C[c])) torn.alpha[c] = 0.01;
    torn.resume();
    const Real before = right(torn), volume = place(torn).volume;
    ASSERT_GT(before, 0);
    for (int i = 0; i < 30; ++i) torn.hold_shape();
    EXPECT_EQ(right(torn), 0) << simplex;
    EXPECT_NEAR(torn.volume_returned, before, 1e-12 * before);
    EXPECT_NEAR(place(torn).volume / volume, 1, 1e-12);

    const shapes::Shape other = shapes::translate(shapes::sphere(0.1), {0.76, 0.5, 0});
    Body two(mesh, weights, {.shape = shapes::unite({one, other}), .G = 1}, {});
    const Real whole = right(two);
    for (Index c = 0; c < mesh.n_cells; ++c)  // a cell's width is worn off
      if (mesh.C[c].x > 0.55 && two.alpha[c] > 0 && two.alpha[c] < 1) two.alpha[c] *= 0.5;
    two.resume();
    for (int i = 0; i < 60; ++i) two.hold_shape();
    EXPECT_GT(right(two), 0.9 * whole) << simplex;

    const shapes::Shape grain = shapes::translate(shapes::box({0.03, 0.03, 1}), {0.76, 0.51, 0});
    Body both(mesh, weights, {.shape = shapes::unite({one, grain}), .G = 1}, {});
    const Real small = right(both);
    ASSERT_GT(small, 0);
    for (int i = 0; i < 30; ++i) both.hold_shape();
    EXPECT_NEAR(right(both), small, 0.2 * small) << simplex;
    EXPECT_EQ(both.volume_returned, 0);
  }
}

}  // namespace
}  // namespace fsi
