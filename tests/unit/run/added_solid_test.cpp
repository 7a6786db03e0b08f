// Solids that are put into a run after its start, and the files that tell of it.

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "libfsi/run/output.hpp"
#include "tests/unit/io/support.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

using test::content;
using test::Folder;

/// A table by its columns.
std::map<std::string, std::vector<Real>> columns_of(const std::string& file) {
  std::istringstream lines(content(file));
  std::string line;
  std::getline(lines, line);
  std::vector<std::string> head;
  std::istringstream names(line);
  for (std::string name; std::getline(names, name, ',');) head.push_back(name);
  std::map<std::string, std::vector<Real>> found;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::size_t i = 0;
    for (std::string word; std::getline(words, word, ','); ++i)
      found[head.at(i)].push_back(std::stod(word));
  }
  return found;
}

/// Discs in a shear between two plates, in steps of 0.02 and rows every 0.05.
struct Stream {
  explicit Stream(const std::string& folder)
      : mesh(
            test::read_box({.n = {32, 16, 0}, .length = {2, 1, 1}, .periodic = {"left", "right"}})),
        options("test", "a test"),
        solver(mesh, {.rho = 1, .mu_f = 0.1},
               {.conditions = {{"top", Wall{{0.5, 0, 0}}}, {"bottom", Wall{{-0.5, 0, 0}}}}}) {
    setup.time = {.end = 1, .step = 0.02};
    setup.output = {.directory = folder, .sample_interval = 0.05};
    solver.start([](const Vec3& x) { return Vec3{x.y - 0.5, 0, 0}; });
    put("one", {0.5, 0.6, 0});
  }
  void put(const std::string& name, const Vec3& centre, bool from_checkpoint = false) {
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.15), centre),
                      .G = 2,
                      .mu = 0.2,
                      .name = name,
                      .from_checkpoint = from_checkpoint});
  }
  void take_step(Output& output, Real end) {
    Clock clock(end, solver.state().t);
    const Limit limit = stable_dt(solver, setup.time);
    const Real dt = solver.advance(clock.step(limit.dt, output.next_event()));
    output.after_step(limit, dt);
  }
  /// Up to `end`, with files in a folder of their own.
  void run(Real end, const std::string& folder) {
    setup.time.end = end;
    setup.output.directory = folder;
    Output output(setup, options, solver, "test");
    while (Clock(end, solver.state().t).running() && output.go_on()) take_step(output, end);
    EXPECT_EQ(output.finish(), RunStatus::complete);
  }
  const Mesh mesh;
  const Options options;
  Case setup;
  Solver solver;
};

TEST(AddedSolid, IsRefusedWhileAnOutputWatches) {
  const Folder folder;
  for (const std::string call : {"go_on", "after_step", "finish"}) {
    Stream stream(folder / call);
    try {
      Output output(stream.setup, stream.options, stream.solver, "test");
      stream.take_step(output, 1);
      stream.put("two", {1.5, 0.4, 0});
      if (call == "go_on") output.go_on();
      if (call == "after_step") stream.take_step(output, 1);
      if (call == "finish") output.finish();
      ADD_FAILURE() << call << " went on";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      const std::string said = error.what();
      EXPECT_NE(said.find("the solver has 2 solids, but 1 when this Output was made"),
                std::string::npos)
          << said;
      EXPECT_NE(said.find("make another in a new folder"), std::string::npos) << said;
    }
    EXPECT_NE(content(folder / (call + "/summary.json")).find("new folder"), std::string::npos);
  }
}

TEST(AddedSolid, ASolidThatIsTakenOutIsRefused) {
  const Folder folder;
  Stream stream(folder / "out");
  Output output(stream.setup, stream.options, stream.solver, "test");
  stream.take_step(output, 1);
  stream.solver.bodies().clear();
  EXPECT_THROW(output.go_on(), Error);
}

// The second of two Outputs goes on where the first one ended: its rows are those of a run with one
// Output, but for what is counted from the start.
TEST(AddedSolid, AnOutputGoesOnWhereAnotherEnded) {
  const Folder folder;
  Stream whole(folder / "whole"), parts(folder / "first");
  {
    Output output(whole.setup, whole.options, whole.solver, "test");
    for (const Real end : {0.5, 1.0})
      while (Clock(end, whole.solver.state().t).running()) whole.take_step(output, end);
    EXPECT_EQ(output.finish(), RunStatus::complete);
  }
  parts.run(0.5, folder / "first");
  parts.run(1, folder / "second");
  for (const std::string table : {"/flow.csv", "/solid_one.csv"}) {
    const auto all = columns_of(folder / ("whole" + table));
    const auto second = columns_of(folder / ("second" + table));
    const auto& t = second.at("t");
    ASSERT_EQ(t.size(), table == "/flow.csv" ? 10U : 11U) << table;
    const std::size_t before = all.at("t").size() - t.size();
    for (const auto& [name, values] : all) {
      if (name == "wall_per_step" || name == "work" || name == "energy_made" ||
          name == "divergence_max" || name == "turned")
        continue;
      // The solid stands half a step behind; no state before the first row tells how it goes on. In
      // that time it turns by less than 0.3 degrees.
      for (std::size_t i = 0; i < t.size(); ++i)
        EXPECT_NEAR(second.at(name)[i], values[before + i], t[i] < 0.51 ? 0.1 : 1e-9)
            << name << " at " << t[i];
    }
  }
}

TEST(AddedSolid, HasItsRowsInTheNextOutput) {
  const Folder folder;
  Stream stream(folder / "first");
  stream.run(0.5, folder / "first");
  stream.put("two", {1.5, 0.4, 0});
  stream.run(1, folder / "second");
  EXPECT_EQ(content(folder / "first/solid_two.csv"), "");
  const auto one = columns_of(folder / "second/solid_one.csv");
  const auto two = columns_of(folder / "second/solid_two.csv");
  ASSERT_EQ(two.at("t"), one.at("t"));
  EXPECT_NEAR(two.at("t").front(), 0.5, 1e-12);
  EXPECT_NEAR(two.at("t").back(), 1, 1e-12);
  EXPECT_NEAR(two.at("x").front(), 1.5, 1e-3);
  EXPECT_NEAR(two.at("y").front(), 0.4, 1e-3);
  // Both go with the fluid at their height.
  EXPECT_NEAR(two.at("x").back() - 1.5, -0.1 * 0.5, 0.01);
  EXPECT_NEAR(one.at("x").back() - one.at("x").front(), 0.1 * 0.5, 0.01);
  EXPECT_NEAR(two.at("volume").back() / two.at("volume").front(), 1, 1e-10);
  const auto flow = columns_of(folder / "second/flow.csv");
  for (const Real made : flow.at("energy_made")) EXPECT_LE(made, 0.01);
}

// The limits by the length of the run count from where the solid was put in.
TEST(AddedSolid, TakesPartsOfWhatIsLeftOfTheRun) {
  const Mesh mesh =
      test::read_box({.n = {16, 16, 0}, .periodic = {"left", "right", "bottom", "top"}});
  Solver solver(mesh, {.rho = 1, .mu_f = 1}, {});
  solver.start([](const Vec3&) { return Vec3{}; });
  while (solver.state().t < 10) solver.step(0.5);
  const auto of = [&](const std::string& name) {
    for (const Limit& limit : limits(solver, {.end = 10.1}))
      if (limit.name == name) return limit.dt;
    return Real{0};
  };
  EXPECT_NEAR(of("end"), 10.1 / 20, 1e-12);
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), {0.5, 0.5, 0}), .G = 1});
  EXPECT_NEAR(of("end"), 0.1 / 20, 1e-12);
  EXPECT_NEAR(of("start"), 0.1 / 100, 1e-12);
}

// Beads enter at one place one after the other. For a restart all of them are put in at once.
TEST(AddedSolid, BeadsThatEnterAtOnePlaceCanBeRestarted) {
  const Folder folder;
  const Vec3 entry{1.2, 0.82, 0};
  Stream whole(folder / "first");
  whole.setup.output.checkpoint_interval = 10;
  whole.put("two", entry);
  whole.run(1.2, folder / "first");
  whole.put("three", entry);
  whole.run(1.5, folder / "second");
  whole.run(1.8, folder / "third");
  Stream again(folder / "second");
  again.setup.output.checkpoint_interval = 10;
  again.setup.output.restart = true;
  again.put("two", entry);
  EXPECT_THROW(again.put("three", entry), Error);
  again.put("three", entry, true);
  again.run(1.8, folder / "second");
  for (const std::string name : {"two", "three"}) {
    const Real one = columns_of(folder / ("third/solid_" + name + ".csv")).at("x").back(),
               other = columns_of(folder / ("second/solid_" + name + ".csv")).at("x").back();
    EXPECT_NEAR(one, other, 1e-9) << name;
  }
}

// Rows that are far apart: the solid goes nearly a whole period of 2 from one to the next.
TEST(Rows, FollowASolidThatGoesFarBetweenThem) {
  const Folder folder;
  const Mesh mesh =
      test::read_box({.n = {32, 16, 0}, .length = {2, 1, 1}, .periodic = {"left", "right"}});
  const Options options("test", "a test");
  Solver solver(mesh, {}, {.conditions = {{"top", Wall{{1, 0, 0}}}, {"bottom", Wall{{1, 0, 0}}}}});
  solver.start([](const Vec3&) { return Vec3{1, 0, 0}; });
  solver.put_solid({.shape = shapes::translate(shapes::sphere(0.15), {0.5, 0.5, 0}), .G = 2});
  Case setup;
  setup.time = {.end = 5.7, .step = 0.03};
  setup.output = {.directory = folder / "out", .sample_interval = 1.9};
  Output output(setup, options, solver, "test");
  Clock clock(setup.time.end, 0);
  while (clock.running() && output.go_on()) {
    const Limit limit = stable_dt(solver, setup.time);
    const Real dt = solver.advance(clock.step(limit.dt, output.next_event()));
    clock.set(solver.state().t);
    output.after_step(limit, dt);
  }
  EXPECT_EQ(output.finish(), RunStatus::complete);
  const auto solid = columns_of(folder / "out/solid.csv");
  ASSERT_EQ(solid.at("t").size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(solid.at("x")[i], 0.5 + solid.at("t")[i], 1e-3);
}

}  // namespace
}  // namespace fsi
