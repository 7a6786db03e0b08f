// Whether the state that a checkpoint gives back is the one it was made of, bit for bit: what two
// ranks hold of a cell or a face must not differ.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/io/layout.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

/// A disc (ball) in a cavity whose lid slides.
struct Scene {
  std::array<Index, 3> n{24, 24, 0};
  bool simplex = false;
  KinematicsKind kinematics = KinematicsKind::log_conformation;
  Real G = 0.1, mu_s = 0.01;
  int steps = 60;
  Real ratio = 1;           ///< of the densities
  bool orthogonal = false;  ///< projection, of a fluid alone
  Real energy = 0;          ///< kinetic, of one rank at the end; 0: not asked for
};

/// Collective. The fields that a checkpoint would hold of which some rank has other values than the
/// owner. The history of the momentum is of owned cells alone.
std::string different(Solver& solver, const io::Layout& cells, const io::Layout& faces) {
  const Mesh& mesh = solver.mesh();
  io::Snapshot all;
  solver.list(all);
  std::string names;
  for (const io::Snapshot::Values& field : all.fields()) {
    if (field.on == Location::boundary || field.name == "convection" ||
        field.name == "convection_before" || field.name == "viscous_rest")
      continue;
    const bool on_cells = field.on == Location::cells;
    const io::Layout& layout = on_cells ? cells : faces;
    std::vector<Real> room, again(static_cast<std::size_t>(on_cells ? mesh.n_cells : mesh.n_faces) *
                                  static_cast<std::size_t>(field.width));
    layout.scatter(layout.gather(field.values, field.width, room), field.width, again.data());
    if (on_cells) mesh.halo.update(again.data(), field.width);
    if (!all_of_ranks(std::equal(again.begin(), again.end(), field.values)))
      names += " " + field.name;
  }
  return names;
}

/// Collective. The numbers that a checkpoint would hold of which some rank has another.
std::string other_scalars(Solver& solver) {
  io::Snapshot all;
  solver.list(all);
  std::string names;
  for (const auto& [name, scalar] : all.scalars())
    if (const auto* real = std::get_if<Real*>(&scalar))
      if (global_max(**real) != global_min(**real)) names += " " + name;
  return names;
}

void expect_one_state(const Scene& scene) {
  const Mesh mesh = test::read_box({.n = scene.n, .simplex = scene.simplex});
  Conditions conditions{{"top", Wall{{1, 0, 0}}}};
  for (const char* name : {"left", "right", "bottom"}) conditions[name] = Wall{};
  if (mesh.dim == 3) conditions["back"] = conditions["front"] = Slip{};
  Solver solver(mesh, {.mu_f = 0.01, .gravity = {0, -1, 0}},
                {.conditions = conditions, .orthogonal_projection = scene.orthogonal});
  solver.start([](const Vec3&) { return Vec3{}; });
  const Vec3 centre{0.6, 0.5, mesh.dim == 3 ? 0.5 : 0};
  if (!scene.orthogonal)
    solver.put_solid({.shape = shapes::translate(shapes::sphere(0.2), centre),
                      .G = scene.G,
                      .mu = scene.mu_s,
                      .kinematics = scene.kinematics,
                      .rho = scene.ratio});
  const io::Layout cells(mesh, Location::cells), faces(mesh, Location::faces);
  for (int i = 0; i < scene.steps; ++i) {
    const Real dt = std::min({0.02, solver.advective_dt(0.5), solver.boundary_dt(0.5),
                              solver.carried_dt(), solver.elastic_dt()});
    ASSERT_GT(solver.advance(dt), 0) << solver.report().failure;
    ASSERT_EQ(different(solver, cells, faces), "") << "after step " << i + 1;
    ASSERT_EQ(other_scalars(solver), "") << "after step " << i + 1;
  }
  if (!scene.energy) return;
  Sum energy;
  for (Index c = 0; c < mesh.n_owned; ++c) energy.add(mesh.V[c] * norm2(solver.state().u[c]) / 2);
  const Real found = energy.total();
  EXPECT_NEAR(found, scene.energy, 1e-4 * scene.energy);
}

TEST(Ranks, HoldOneStateOfAHeavyDisc) {
  expect_one_state({.ratio = 3});
  expect_one_state({.simplex = true, .steps = 30, .ratio = 3});
  expect_one_state({.n = {10, 10, 10}, .steps = 10, .ratio = 0.5});
}
TEST(Ranks, HoldOneStateOfADisc) { expect_one_state({.steps = 250}); }

TEST(Ranks, HoldOneStateOfAMappedDisc) {
  expect_one_state({.kinematics = KinematicsKind::reference_map});
}

TEST(Ranks, HoldOneStateForThePaperScheme) {
  expect_one_state({.kinematics = KinematicsKind::left_cauchy_green});
}

TEST(Ranks, HoldOneStateOnTriangles) { expect_one_state({.n = {16, 16, 0}, .simplex = true}); }

TEST(Ranks, HoldOneStateWithTwoViscosities) {
  for (const Real mu_s : {0.002, 0.1}) expect_one_state({.mu_s = mu_s});
}

// What conjugate gradients leave of a step's divergence differs with the ranks, hence the 1e-4.
TEST(Ranks, HoldOneStateOfAnOrthogonalProjection) {
  expect_one_state(
      {.n = {16, 16, 0}, .simplex = true, .steps = 20, .orthogonal = true, .energy = 0.0121770118});
  expect_one_state(
      {.n = {6, 6, 6}, .simplex = true, .steps = 10, .orthogonal = true, .energy = 0.00533567});
}

TEST(Ranks, HoldOneStateOfABall) {
  for (const bool simplex : {false, true})
    expect_one_state({.n = {8, 8, 8}, .simplex = simplex, .steps = 10});
}

// Without an opening the pressure is known but for a constant. With a direct solver it vanishes in
// the cell of number 0, whichever rank has this cell.
TEST(Ranks, ThePressureOfAClosedBoxHasTheSameLevel) {
  const Mesh mesh = test::read_box({.n = {8, 24, 0}, .length = {1, 3, 1}});
  Conditions conditions{{"top", Wall{{1, 0, 0}}}};
  for (const char* name : {"left", "right", "bottom"}) conditions[name] = Wall{};
  Solver solver(mesh, {.rho = 1, .mu_f = 0.1}, {.conditions = conditions});
  solver.start([](const Vec3&) { return Vec3{}; });
  for (int i = 0; i < 5; ++i) solver.step(0.02);
  Real first = 0, most = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    most = std::max(most, std::abs(solver.state().p[c]));
    if (mesh.global_id[c] == 0) first = std::abs(solver.state().p[c]);
  }
  EXPECT_LT(global_max(first), 1e-5 * global_max(most));
}

}  // namespace
}  // namespace fsi
