#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

Mesh channel(Index n, bool triangles = false) {
  return test::read_box({.n = {2 * n, n, 0}, .length = {2, 1, 1}, .simplex = triangles});
}

Real flow_rate(const Solver& solver, const std::string& name) {
  const Patch& patch = solver.mesh().patch(name);
  Sum sum;
  for (Index f = patch.begin; f < patch.end; ++f) sum.add(solver.state().phi[f]);
  return sum.total();
}

Real pressure(const Solver& solver, const std::string& name) {
  const Patch& patch = solver.mesh().patch(name);
  Sum p, area;
  for (Index f = patch.begin; f < patch.end; ++f) {
    p.add(norm(solver.mesh().Sf[f]) * solver.p_b()[f - solver.mesh().n_internal]);
    area.add(norm(solver.mesh().Sf[f]));
  }
  return p.total() / area.total();
}

/// Mean pressure and x of the cells at a patch.
std::pair<Real, Real> beside(const Solver& solver, const std::string& name) {
  const Patch& patch = solver.mesh().patch(name);
  Sum p, x, count;
  for (Index f = patch.begin; f < patch.end; ++f) {
    const Index c = solver.mesh().owner[f];
    p.add(solver.state().p[c]), x.add(solver.mesh().C[c].x), count.add(1);
  }
  const Real n = count.total();
  return {p.total() / n, x.total() / n};
}

Real net_flow(const Solver& solver) {
  Sum sum;
  for (Index f = solver.mesh().n_internal; f < solver.mesh().n_faces; ++f)
    sum.add(solver.state().phi[f]);
  return sum.total();
}

TEST(Inflow, AParabolaIsTheDevelopedFlowAndCarriesItsRate) {
  for (const bool triangles : {false, true}) {
    const Mesh mesh = channel(8, triangles);
    const Patch& left = mesh.patch("left");
    const std::vector<Vec3> shape = inflow_shape(InflowProfile::parabola, left, mesh, {});
    Sum rate;
    for (Index f = left.begin; f < left.end; ++f) {
      const Real y = mesh.Cf[f].y, h = norm(mesh.Sf[f]);
      // the finite elements are exact at the nodes; the mean of their straight line over a face
      EXPECT_NEAR(shape[f - left.begin].x, 6 * (y * (1 - y) - h * h / 4) / (1 - h * h), 1e-10);
      rate.add(dot(shape[f - left.begin], mesh.Sf[f]));
    }
    EXPECT_NEAR(rate.total(), -1, 1e-13);
  }
}

TEST(Inflow, APlaneWithoutFrictionDoesNotHoldIt) {
  const Mesh mesh = channel(8);
  const Patch& left = mesh.patch("left");
  const std::vector<Vec3> half =
      inflow_shape(InflowProfile::parabola, left, mesh, {mesh.patch("top")});
  for (Index f = left.begin; f < left.end; ++f) {
    const Real y = mesh.Cf[f].y;
    EXPECT_NEAR(half[f - left.begin].x, 1.5 * y * (2 - y), 0.02);
  }
}

TEST(Inflow, AProfileGoesOnThroughAPeriod) {
  for (const bool tets : {false, true}) {
    const Mesh mesh =
        test::read_box({.n = {3, 8, 3}, .simplex = tets, .periodic = {"back", "front"}});
    const Patch& left = mesh.patch("left");
    const std::vector<Vec3> shape = inflow_shape(InflowProfile::parabola, left, mesh, {});
    for (Index f = left.begin; f < left.end; ++f) {
      const Real y = mesh.Cf[f].y;
      EXPECT_NEAR(shape[f - left.begin].x, 6 * y * (1 - y), 0.06);
    }
  }
}

// A patch like a roof has no direction in which all of its flow goes.
TEST(Inflow, NeedsFacesThatLookOneWay) {
  const auto refused = [](Real height, InflowProfile profile) {
    const Mesh mesh = test::read_box({.n = {8, 8, 0}, .moved = [height](const Vec3& x) {
                                        const Real roof = height * std::abs(x.y - 0.5);
                                        return x - Vec3{(1 - x.x) * roof, 0, 0};
                                      }});
    try {
      inflow_shape(profile, mesh.patch("left"), mesh, {});
    } catch (const Error& error) {
      return std::string(error.what()).find("\"left\" look different ways") != std::string::npos;
    }
    return false;
  };
  EXPECT_FALSE(refused(0.3, InflowProfile::parabola));
  EXPECT_TRUE(refused(0.6, InflowProfile::parabola));
  EXPECT_FALSE(refused(0.6, InflowProfile::plug)) << "a wind through a curved patch";
  EXPECT_TRUE(refused(2, InflowProfile::plug));
}

TEST(Inflow, WithoutFrictionAtTheRimItIsAPlug) {
  const Mesh mesh = channel(8);
  const Patch& left = mesh.patch("left");
  for (const Vec3& u :
       inflow_shape(InflowProfile::parabola, left, mesh, {mesh.patch("top"), mesh.patch("bottom")}))
    EXPECT_NEAR(u.x, 1, 1e-12);
}

TEST(Openings, FlowRatesWithoutAWayOutAreRefused) {
  const Mesh mesh = channel(4);
  Conditions conditions{
      {"left", FlowRate{1}}, {"right", FlowRate{-0.9}}, {"bottom", Wall{}}, {"top", Wall{}}};
  EXPECT_THROW(resolve(conditions, mesh), Error);
  conditions["right"] = FlowRate{-1};
  EXPECT_NO_THROW(resolve(conditions, mesh));
  conditions["right"] = Opening{.pressure = 0, .load = {.capacitance = 1}};
  EXPECT_THROW(resolve(conditions, mesh), Error);
}

// Q = p / (R + 12 mu L): Poiseuille's resistance of the channel in series with that beyond it.
TEST(Openings, AResistanceBeyondTheOutletStandsInSeries) {
  const Mesh mesh = channel(16);
  const Real mu = 0.5, R = 30;
  Solver solver(mesh, {.rho = 1, .mu_f = mu},
                {.conditions = {{"left", Opening{1}},
                                {"right", Opening{.pressure = 0.25, .load = {.proximal = R}}},
                                {"bottom", Wall{}},
                                {"top", Wall{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (int i = 0; i < 100; ++i) {
    solver.step(0.05);
    ASSERT_NEAR(net_flow(solver), 0, 1e-13);
  }
  const Real Q = flow_rate(solver, "right");
  EXPECT_NEAR(Q, 0.75 / (R + 12 * mu * 2), 3e-3 * Q);
  EXPECT_NEAR(pressure(solver, "right"), 0.25 + R * Q, 1e-6);
}

/// Largest error of the outlet's pressure, from the windkessel under a given pulse.
Real windkessel_error(Real dt) {
  const Load load{.proximal = 2, .distal = 10, .capacitance = 0.05, .stored = 1};
  const auto Q = [](Real t) { return std::pow(std::sin(std::numbers::pi * t), 2); };
  const Mesh mesh = channel(4);
  Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                {.conditions = {{"left", FlowRate{Q}},
                                {"right", Opening{.pressure = 0, .load = load}},
                                {"bottom", Wall{}},
                                {"top", Wall{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  // p_c by steps a hundredth as long
  Real p_c = load.stored, worst = 0;
  const auto slope = [&](Real t, Real p) { return (Q(t) - p / load.distal) / load.capacitance; };
  for (int i = 0; i < static_cast<int>(std::lround(2 / dt)); ++i) {
    solver.step(dt);
    const auto go = [&](Real t, Real h) {
      const Real k1 = slope(t, p_c), k2 = slope(t + h / 2, p_c + h / 2 * k1),
                 k3 = slope(t + h / 2, p_c + h / 2 * k2), k4 = slope(t + h, p_c + h * k3);
      p_c += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    };
    for (int k = 0; k < 50; ++k) go(i * dt + k * dt / 100, dt / 100);
    const Real middle = (i + 0.5) * dt;
    if (i >= 2)
      worst = std::max(
          worst, std::abs(solver.opening_pressure("right") - (load.proximal * Q(middle) + p_c)));
    for (int k = 50; k < 100; ++k) go(i * dt + k * dt / 100, dt / 100);
  }
  return worst;
}

TEST(Openings, AWindkesselFollowsItsEquationToSecondOrder) {
  const Real coarse = windkessel_error(1.0 / 40), fine = windkessel_error(1.0 / 80);
  std::printf("windkessel, dt 1/40 and 1/80: p off by %.2e %.2e, order %.2f\n", coarse, fine,
              std::log2(coarse / fine));
  EXPECT_LE(fine, 0.01);
  EXPECT_GE(std::log2(coarse / fine), 1.8);
}

// At a Reynolds number of 1e-3 a step is 250 times as long as the slowest decay of the flow: the
// pressure follows the flow rate, also beside an outlet whose own pressure changes by far more.
TEST(Openings, APressureFollowsItsFlowRateAtAnyViscosity) {
  const Real mu = 1000, dt = 0.025, R = 12 * mu * 2;
  const auto Q = [](Real t) { return 1 + 0.5 * std::sin(2 * std::numbers::pi * t); };
  const auto p_out = [&](Real t) { return 1e6 * std::cos(2 * std::numbers::pi * t); };
  for (const bool triangles : {false, true})
    for (const bool loaded : {false, true}) {
      const Mesh mesh = channel(16, triangles);
      Opening outlet =
          loaded ? Opening{.pressure = 0, .load = {.proximal = 20 * R}} : Opening{p_out};
      Solver solver(
          mesh, {.rho = 1, .mu_f = mu},
          {.conditions = {
               {"left", FlowRate{Q}}, {"right", outlet}, {"bottom", Wall{}}, {"top", Wall{}}}});
      solver.start([](const Vec3&) { return Vec3{}; });
      Real worst = 0;
      for (int i = 0; i < 60; ++i) {
        solver.step(dt);
        if (i < 20) continue;
        // over what lies between the cells at the inlet and the outlet
        const auto [p, x] = beside(solver, "left");
        const Real part = (p - pressure(solver, "right")) / (R * (2 - x) / 2);
        worst = std::max(worst, std::abs(part - Q((i + 0.5) * dt)));
      }
      std::printf("%s%s: the drop of pressure is off by %.4f of that of the mean\n",
                  triangles ? "triangles" : "quads", loaded ? " with a load" : "", worst);
      EXPECT_LE(worst, 0.03);
    }
}

// Between sides that slip a flow has no friction, and the increments may not add up to growth.
TEST(Openings, APressureBetweenSidesThatSlipDoesNotGrow) {
  const Mesh mesh = channel(8);
  Solver solver(mesh, {.rho = 1, .mu_f = 1e5},
                {.conditions = {{"left", FlowRate{[](Real t) { return 1 + 0.5 * std::sin(t); },
                                                  InflowProfile::plug}},
                                {"right", Opening{0}},
                                {"bottom", Slip{}},
                                {"top", Slip{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  const auto largest = [&](int steps) {
    Real p = 0;
    for (int i = 0; i < steps; ++i) {
      solver.step(0.025);
      for (Index c = 0; c < mesh.n_owned; ++c) p = std::max(p, std::abs(solver.state().p[c]));
    }
    return global_max(p);
  };
  const Real first = largest(40);
  EXPECT_LE(largest(160), first);
}

// The fluid feels differences of pressure alone: in SI units the level is 10^5, the difference 1.
TEST(Openings, TheLevelOfThePressureMovesNothing) {
  for (const bool triangles : {false, true}) {
    const Mesh mesh = channel(8, triangles);
    const auto run = [&](Real level, Real drop) {
      Solver solver(mesh, {.rho = 1, .mu_f = 0.1},
                    {.conditions = {{"left", Opening{level + drop}},
                                    {"right", Opening{level}},
                                    {"bottom", Wall{}},
                                    {"top", Wall{}}}});
      solver.start([](const Vec3&) { return Vec3{}; });
      for (int i = 0; i < 3; ++i) solver.step(0.01);
      return flow_rate(solver, "right");
    };
    EXPECT_EQ(run(1e5, 0), 0);
    const Real rate = run(0, 1);
    EXPECT_NEAR(run(1e5, 1), rate, 1e-8 * rate);
  }
}

/// A mesh in space, one cell thick between two planes of symmetry, has the flow of the plane one.
TEST(Openings, OneLayerOfCellsFlowsLikeAPlane) {
  constexpr Real depth = 0.25;
  const auto run = [&](Index layers) {
    const Mesh mesh =
        test::read_box({.n = {16, 8, layers}, .length = {2, 1, layers > 0 ? depth : 1}});
    Conditions conditions{{"left", FlowRate{.rate = layers > 0 ? depth : 1}},
                          {"right", Opening{}},
                          {"bottom", Wall{}},
                          {"top", Wall{}}};
    if (layers > 0) conditions["back"] = conditions["front"] = Slip{};
    Solver solver(mesh, {.rho = 1, .mu_f = 0.05}, {.conditions = conditions});
    solver.start([](const Vec3&) { return Vec3{}; });
    for (int i = 0; i < 5; ++i) solver.step(0.01);
    Sum u, n;
    const Patch& left = mesh.patch("left");
    for (Index f = left.begin; f < left.end; ++f)
      u.add(std::abs(solver.state().u[mesh.owner[f]].x)), n.add(1);
    return std::pair{beside(solver, "left").first, u.total() / n.total()};
  };
  const auto [p, u] = run(0);
  const auto [p_layer, u_layer] = run(1);
  EXPECT_NEAR(p_layer, p, 1e-5 * p);
  EXPECT_NEAR(u_layer, u, 1e-5 * u);
}

TEST(Openings, ABodyForceDrivesLikeAPressure) {
  const Mesh mesh = channel(16, true);
  const Real mu = 0.5;
  Solver solver(mesh, {.rho = 1, .mu_f = mu},
                {.conditions = {{"left", Opening{0}},
                                {"right", Opening{0}},
                                {"bottom", Wall{}},
                                {"top", Wall{}}},
                 .body_force = [](const Vec3&, Real) {
                   return Vec3{1, 0, 0};
                 }});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (int i = 0; i < 60; ++i) solver.step(0.05);
  EXPECT_NEAR(flow_rate(solver, "right"), 1 / (12 * mu), 0.01 / (12 * mu));
}

/// 8 x 8 squares in two triangles each, the vertex at x put there.
Mesh with_vertex(const Vec3& x, const Vec3& there) {
  return test::read_box({.n = {8, 8, 0}, .simplex = true, .moved = [&](const Vec3& from) {
                           return norm(from - x) < 1e-9 ? there : from;
                         }});
}

/// The largest speed of a hundred steps from u.
Real largest_speed(Solver& solver, const std::function<Vec3(const Vec3&)>& u) {
  solver.start(u);
  Real speed = 0;
  for (int i = 0; i < 100; ++i) {
    solver.step(solver.advective_dt(0.5));
    for (Index c = 0; c < solver.mesh().n_owned; ++c)
      speed = std::max(speed, norm(solver.state().u[c]));
  }
  return global_max(speed);
}

constexpr Real h = 1.0 / 8;
const FixedVelocity across{[](const Vec3& x, Real) {
  return Vec3{1 + 4 * x.y * (1 - x.y), -1, 0};
}};
Vec3 shaken(const Vec3& x) {
  return across.u(x, 0) + 0.1 * Vec3{std::sin(40 * x.y), std::sin(40 * x.x), 0};
}

// The flow crosses the flat triangle 83 times in a step; its neighbours, once in two steps.
TEST(Openings, AFlatCellBearsTheStepsOfItsNeighbours) {
  constexpr Real flat = 0.005;
  const Mesh mesh =
      with_vertex({0.5, 0.5, 0}, Vec3{0.5, 0.5, 0} + ((1 - flat) * h / 2) * Vec3{-1, 1, 0});
  Solver solver(
      mesh, {.rho = 1, .mu_f = 1e-5},
      {.conditions = {
           {"left", across}, {"top", across}, {"right", Opening{}}, {"bottom", Opening{}}}});
  EXPECT_LT(largest_speed(solver, shaken), 3);
}

TEST(Openings, AVelocityToStartFromIsFinite) {
  const Mesh mesh = channel(4);
  Solver solver(
      mesh, {.rho = 1, .mu_f = 0.1},
      {.conditions = {
           {"left", Opening{}}, {"right", Opening{}}, {"bottom", Wall{}}, {"top", Wall{}}}});
  try {
    solver.start([](const Vec3& x) { return Vec3{x.x > 1.8 ? std::sqrt(1.8 - x.x) : 0, 0, 0}; });
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "the velocity to start from is not finite at (1.875, 0.125, 0)");
  }
}

// So it does with one side at the boundary where the flow comes in.
TEST(Openings, AFlatCellAtAnInletDoesNotGrow) {
  for (const Real flat : {0.1, 0.05, 0.005}) {
    const Mesh mesh = with_vertex({h, 0.5, 0}, {flat * h, 0.5 - h / 2, 0});
    Solver given(
        mesh, {.rho = 1, .mu_f = 1e-5},
        {.conditions = {
             {"left", across}, {"top", across}, {"right", Opening{}}, {"bottom", Opening{}}}});
    EXPECT_LT(largest_speed(given, shaken), 3) << flat;
    Solver driven(
        mesh, {.rho = 1, .mu_f = 1e-3},
        {.conditions = {
             {"left", Opening{1}}, {"right", Opening{}}, {"top", Wall{}}, {"bottom", Wall{}}}});
    EXPECT_LT(largest_speed(driven,
                            [](const Vec3& x) {
                              return Vec3{4 * x.y * (1 - x.y), 0, 0};
                            }),
              6)
        << flat;
  }
}

}  // namespace
}  // namespace fsi
