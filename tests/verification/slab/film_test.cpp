// A solid between the walls y = 0 and 1 of a channel, with a film of thickness h_f thinner than a
// cell at each. A body force a on it is borne by the viscous stress in the films:
//   rho a (1 - 2 h_f) = 2 mu_f U / h_f,
// with U the velocity of the solid, which is not strained by the walls.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

constexpr Real mu = 0.1, a = 0.1;

struct Film {
  Index n;         ///< cells across
  Real thickness;  ///< in cells of 1 / n
  bool asked;      ///< whether the option is given, with half of the thickness
  Real mu_s = mu;  ///< of the solid
  bool simplex = false, memory = false;
};

struct Result {
  Real velocity = 0;  ///< mean of the solid, in units of the exact one
  Real strain = 0;    ///< largest |B_xy| in cells of the solid, in units of that of the force
};

/// The solid when it moves steadily.
Result slide(const Film& film) {
  const Real thickness = film.thickness / film.n, height = 1 - 2 * thickness, G = 10;
  const Mesh mesh = test::read_box({.n = {4, film.n, 0},
                                    .length = {4.0 / film.n, 1, 1},
                                    .simplex = film.simplex,
                                    .periodic = {"left", "right"}});
  Solver solver(mesh, {.rho = 1, .mu_f = mu},
                {.conditions = {{"bottom", Wall{}}, {"top", Wall{}}}});
  solver.put_solid({.shape = shapes::translate(shapes::box({200, height, 200}), {0, 0.5, 0}),
                    .G = G,
                    .mu = film.mu_s,
                    .acceleration = {a, 0, 0},
                    .memory = film.memory,
                    .film_thickness = film.asked ? thickness / 2 : 0});
  const Real end = 8, dt = 0.2 / film.n;
  while (solver.state().t < end) solver.step(dt);
  const Body& body = *solver.body();
  Sum moved, volume;
  Real strain = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    moved.add(mesh.V[c] * body.alpha[c] * solver.state().u[c].x);
    volume.add(mesh.V[c] * body.alpha[c]);
    if (body.alpha[c] >= 0.5) strain = std::max(strain, std::abs(body.B_of(c).xy));
  }
  const Result result{moved.total() / volume.total() / (a * height * thickness / (2 * mu)),
                      strain / (a * height / (2 * G))};
  std::printf(
      "film of %.2f cells, %d %s across, viscosity ratio %g, %s, %s: velocity %.4f, strain %.3f\n",
      film.thickness, film.n, film.simplex ? "triangles" : "quads", film.mu_s / mu,
      film.asked ? "friction by its thickness" : "friction by the mesh",
      film.memory ? "memory" : "no memory", result.velocity, result.strain);
  return result;
}

TEST(Film, BearsTheForceOnTheSolid) {
  for (const Film& film : {Film{16, 0.3, true}, Film{32, 0.3, true}, Film{16, 0.2, true},
                           Film{16, 0.3, true, 10 * mu}, Film{16, 0.2, true, mu, true}}) {
    const Result result = slide(film);
    EXPECT_NEAR(result.velocity, 1, film.simplex ? 0.06 : 0.005);
    EXPECT_NEAR(result.strain, 1, film.simplex ? 0.4 : 0.2);
  }
}

// Without the option the film brakes as if it were half a cell thick.
TEST(Film, IsHalfACellThickByDefault) {
  for (const Real mu_s : {mu, 10 * mu})
    EXPECT_NEAR(slide({16, 0.3, false, mu_s}).velocity, 0.5 / 0.3, 0.01);
}

// The memory is carried in the cells at the wall, too. Extrapolated to them, it would not know that
// the solid farther in slips past them, and would draw the strain back: the inside would move 19 %
// too fast.
TEST(Film, MemoryHoldsTheCellsAtTheWall) {
  for (const Film& film :
       {Film{16, 0.3, true, mu, false, true}, Film{32, 0.3, true, mu, false, true},
        Film{16, 0.3, true, 10 * mu, false, true}, Film{16, 0.2, true, mu, true, true}})
    EXPECT_NEAR(slide(film).velocity, 1, film.simplex ? 0.11 : 0.005);
}

}  // namespace
}  // namespace fsi
