// Columns that a driver adds to flow.csv: in its rows as any other, over a restart too.

#include "libfsi/run/output.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <utility>

#include "libfsi/core/parallel.hpp"
#include "tests/unit/io/support.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

using test::Folder;

/// Flow between two plates in steps of 0.1 and rows every 0.25, up to `end`; flow.csv.
std::string channel(const std::string& folder, Real end, bool restart, const std::string& column) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}, .periodic = {"left", "right"}});
  const Options options("test", "a test");
  Case setup;
  setup.flow.conditions = {{"bottom", Wall{}}, {"top", Wall{}}};
  setup.flow.body_force = [](const Vec3&, Real) { return Vec3{0.1, 0, 0}; };
  setup.time = {.end = end, .step = 0.1};
  setup.output = {.directory = folder, .sample_interval = 0.25, .checkpoint_interval = 10};
  setup.output.restart = restart;
  Solver solver(mesh, setup.physics, setup.flow);
  solver.start([](const Vec3&) { return Vec3{}; });
  const auto square = [](const Solver& s) { return s.state().t * s.state().t; };
  Output output(setup, options, solver, "test",
                {{column, square}, {"of_step", square, Course::step}});
  Clock clock(end, solver.state().t);
  while (clock.running() && output.go_on()) {
    const Limit limit = stable_dt(solver, setup.time);
    const Real dt = solver.advance(clock.step(limit.dt, output.next_event()));
    clock.set(solver.state().t);
    output.after_step(limit, dt);
  }
  EXPECT_EQ(output.finish(), RunStatus::complete);
  return test::content(folder + "/flow.csv");
}

/// The columns of a table by name.
std::map<std::string, std::vector<Real>> columns(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> head;
  std::map<std::string, std::vector<Real>> found;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::size_t i = 0;
    const bool first = found.empty();
    for (std::string word; std::getline(words, word, ','); ++i) {
      if (first)
        head.push_back(word);
      else
        found[head[i]].push_back(std::stod(word));
    }
    for (const std::string& name : head) found[name];
  }
  return found;
}

TEST(Output, ADriversColumnIsSampledAsTheOthers) {
  const Folder folder;
  const auto flow = columns(channel(folder / "whole", 1, false, "square"));
  ASSERT_EQ(flow.at("t"), (std::vector<Real>{0.25, 0.5, 0.75, 1}));
  const std::vector<Real> squares{0.065, 0.25, 0.565, 1}, of_steps{0.09, 0.25, 0.64, 1};
  for (std::size_t i = 0; i < squares.size(); ++i) {
    EXPECT_NEAR(flow.at("square")[i], squares[i], 1e-12);
    EXPECT_NEAR(flow.at("of_step")[i], of_steps[i], 1e-12);
  }
  // The flow starts at once in all cells; walls have not held it back yet.
  EXPECT_NEAR(flow.at("mean_velocity")[0], 0.1 * 0.25, 0.2 * 0.025);
  EXPECT_EQ(flow.at("flow_rate"), flow.at("mean_velocity"));
}

TEST(Output, ARestartGoesOnWithADriversColumn) {
  const Folder folder;
  const auto whole = columns(channel(folder / "whole", 1, false, "square"));
  channel(folder / "parts", 0.7, false, "square");
  const auto parts = columns(channel(folder / "parts", 1, true, "square"));
  for (const auto& [name, values] : whole) {
    if (name == "wall_per_step" || name == "divergence_max") continue;
    ASSERT_EQ(parts.at(name).size(), values.size()) << name;
    // The last step before 0.7 is as long as the others but for its last bits.
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(parts.at(name)[i], values[i], 1e-12) << name;
  }
}

TEST(Output, ADriversColumnHasANameOfItsOwn) {
  const Folder folder;
  const auto sentence = [&](const std::string& name) {
    try {
      channel(folder / "named", 1, false, name);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  for (const std::string name : {"t", "dt", "of_step"})
    EXPECT_NE(sentence(name).find("two columns \"" + name + "\""), std::string::npos) << name;
  for (const char* name : {"", "x,y", "\"x", "x\ny"})
    EXPECT_NE(sentence(name).find("cannot be the name of a column"), std::string::npos) << name;
}

/// What a driver forgets.
enum class Left { nothing, after_step, finish, clock };

/// The words on standard error of a run to t = 0.3, and its summary.
std::pair<std::string, std::string> forgetful(const std::string& folder, Left left) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}, .periodic = {"left", "right"}});
  const Options options("test", "a test");
  Case setup;
  setup.flow.conditions = {{"bottom", Wall{}}, {"top", Wall{}}};
  setup.time = {.end = 0.3, .step = 0.1};
  setup.output = {.directory = folder, .sample_interval = 0.1};
  if (left == Left::nothing) setup.solids.emplace_back();
  testing::internal::CaptureStderr();
  {
    Solver solver(mesh, setup.physics, setup.flow);
    solver.start([](const Vec3&) { return Vec3{}; });
    Output output(setup, options, solver, "test");
    for (int i = 0; i < (left == Left::clock ? 5 : 3); ++i) {
      const Real dt = solver.advance(0.1);
      if (left != Left::after_step) output.after_step(stable_dt(solver, setup.time), dt);
    }
    if (left != Left::finish) {
      EXPECT_EQ(output.finish(), RunStatus::complete);
    }
  }
  return {testing::internal::GetCapturedStderr(), test::content(folder + "/summary.json")};
}

TEST(Output, WhatADriverForgetsIsTold) {
  const Folder folder;
  const auto expect = [&](Left left, const char* words, const char* status) {
    const auto [said, summary] = forgetful(folder / "run", left);
    if (rank() == 0) {
      EXPECT_NE(said.find(words), std::string::npos) << said;
    }
    EXPECT_NE(summary.find(status), std::string::npos) << summary;
  };
  expect(Left::nothing, "the case has a solid and the solver none", "\"complete\"");
  expect(Left::after_step, "3 of 3 steps are in no file", "\"complete\"");
  expect(Left::finish, "the driver ended without Output::finish()", "without Output::finish()");
  expect(Left::clock, "a step begins at t = 0.3, at or past the end at 0.3", "\"complete\"");
}

TEST(Output, AColumnHasAFunction) {
  const Folder folder;
  const Mesh mesh = test::read_box({.n = {4, 4, 0}, .periodic = {"left", "right"}});
  const Options options("test", "a test");
  Case setup;
  setup.flow.conditions = {{"bottom", Wall{}}, {"top", Wall{}}};
  setup.output = {.directory = folder / "run"};
  Solver solver(mesh, setup.physics, setup.flow);
  solver.start([](const Vec3&) { return Vec3{}; });
  EXPECT_THROW(Output(setup, options, solver, "test", {{"mine", {}}}), Error);
}

}  // namespace
}  // namespace fsi
