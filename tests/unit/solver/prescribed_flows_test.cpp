// Patches that prescribe all that flows in and out.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <type_traits>
#include <variant>

#include "libfsi/core/error.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

Mesh channel() { return test::read_box({.n = {8, 4, 0}, .length = {2, 1, 1}}); }

/// What the solver says when it is made and steps to t = 1; "" where it says nothing.
std::string fault(const Condition& left, const Condition& right) {
  const Mesh mesh = channel();
  try {
    Solver solver(
        mesh, {.rho = 1, .mu_f = 0.1},
        {.conditions = {{"left", left}, {"right", right}, {"bottom", Slip{}}, {"top", Slip{}}}});
    solver.start([](const Vec3&) { return Vec3{}; });
    while (solver.state().t < 1)
      if (solver.advance(0.1) == 0) {
        // So a loop that does not look at the 0 ends, too.
        EXPECT_THROW(solver.advance(0.1), Error);
        return solver.report().failure;
      }
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
}

/// Copies all that the next step depends on.
void hand_on(Solver& from, Solver& to) {
  io::Snapshot a, b;
  from.list(a), to.list(b);
  for (std::size_t i = 0; i < a.scalars().size(); ++i)
    std::visit(
        [&](auto* value) {
          *value = *std::get<std::decay_t<decltype(value)>>(a.scalars()[i].second);
        },
        b.scalars()[i].second);
}

// Where a flow turns round, what goes in and out is compared with the most that has passed. A run
// that goes on must know of it.
TEST(PrescribedFlows, AFlowThatTurnsRoundGoesOn) {
  const Mesh mesh = channel();
  const auto rate = [](Real sign, Real more) {
    return FlowRate{[=](Real t) { return sign * std::cos(std::numbers::pi / 2 * t) + more; }};
  };
  const FlowSetup setup{
      .conditions = {
          {"left", rate(1, 5e-4)}, {"right", rate(-1, 0)}, {"bottom", Slip{}}, {"top", Slip{}}}};
  Solver first(mesh, {.rho = 1, .mu_f = 0.1}, setup), second(mesh, {.rho = 1, .mu_f = 0.1}, setup);
  for (Solver* solver : {&first, &second}) solver->start([](const Vec3&) { return Vec3{}; });
  while (first.state().t < 0.95) ASSERT_GT(first.advance(0.1), 0) << first.report().failure;
  hand_on(first, second);
  EXPECT_GT(second.advance(0.1), 0) << second.report().failure;
}

TEST(PrescribedFlows, WhatFlowsInMustFlowOut) {
  const auto uniform = [](Real speed) {
    return FixedVelocity{[=](const Vec3&, Real) { return Vec3{speed, 0, 0}; }};
  };
  const FixedVelocity later{[](const Vec3&, Real t) { return Vec3{t, 0, 0}; }};
  const FixedVelocity along{[](const Vec3&, Real) { return Vec3{1e-18, 1, 0}; }};
  EXPECT_EQ(fault(uniform(1), uniform(1)), "");
  EXPECT_EQ(fault(uniform(1), uniform(0.99)), "") << "as far as a velocity is known";
  EXPECT_EQ(fault(uniform(1), Opening{}), "");
  EXPECT_EQ(fault(along, Wall{}), "") << "nothing passes";
  EXPECT_EQ(fault(FlowRate{1}, FlowRate{-1}), "");
  const auto has = [](const std::string& said, const char* words) {
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  const char* start =
      "at t = 0 1 more flows in through the patches per unit of time, where 1 flows in";
  has(fault(uniform(1), Wall{}), start);
  has(fault(FlowRate{1}, Wall{}), start);
  has(fault(uniform(1), uniform(0.5)), "0.5 more flows in");
  has(fault(later, Wall{}), "more flows in through");
  has(fault(FlowRate{[](Real t) { return 1 + std::max(0.0, t - 0.35); }}, FlowRate{-1}),
      "at t = 0.4 0.05 more flows in");
  has(fault(uniform(std::nan("")), Wall{}), "at t = 0 what is given at the patches is not finite");
  has(fault(FixedVelocity{}, Opening{}), "what is given at patch \"left\" is empty");
  has(fault(Opening{OfTime::nothing()}, Opening{}), "what is given at patch \"left\" is empty");
}

// Two tables of one oscillation, each with its own rounding, differ most beside the flow where it
// turns.
TEST(PrescribedFlows, AFlowThatTurnsIsJudgedByItsLargest) {
  const auto wave = [](Real rounding) {
    return [=](Real t) { return std::sin(7 * (t + 0.1)) + rounding * std::cos(30 * t); };
  };
  const auto along = [&](Real rounding) {
    return FixedVelocity{[=](const Vec3&, Real t) { return Vec3{wave(rounding)(t), 0, 0}; }};
  };
  EXPECT_EQ(fault(along(0.005), along(-0.005)), "");
  EXPECT_EQ(fault(FlowRate{wave(2e-4)}, FlowRate{[&](Real t) { return -wave(-2e-4)(t); }}), "");
}

}  // namespace
}  // namespace fsi
