// Several solids that overlap in some cells.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi {
namespace {

struct Crowd {
  Crowd(bool simplex, std::span<const Vec3> places)
      : mesh(test::read_box({.n = {40, 32, 0}, .length = {1.25, 1, 1}, .simplex = simplex})),
        solver(mesh, {.rho = 1, .mu_f = 0.1},
               {.conditions = {
                    {"left", Wall{}}, {"right", Wall{}}, {"top", Wall{}}, {"bottom", Wall{}}}}) {
    solver.start([](const Vec3&) { return Vec3{}; });
    for (const Vec3& at : places)
      solver.put_solid({.shape = shapes::translate(shapes::sphere(0.15), at),
                        .G = 1,
                        .mu = 0.1,
                        .name = "solid" + std::to_string(solver.bodies().size()),
                        .memory = false});
  }
  const Mesh mesh;
  Solver solver;
};

// Two discs overlap in some cells, where a third one has left a wisp far outside of its band. They
// are separated there as far as there is room, and the rest is told, whichever solid the wisp is
// of.
TEST(Overlap, IsNotHiddenByAWispOfAnother) {
  const Vec3 far{0.2, 0.8, 0}, left{0.48, 0.39, 0}, right{0.8, 0.39, 0};
  for (const bool first : {false, true}) {
    Crowd crowd(false, first ? std::array{far, left, right} : std::array{left, right, far});
    auto& bodies = crowd.solver.bodies();
    CellField<Real>&wisp = bodies[first ? 0 : 2].alpha, &a = bodies[first ? 1 : 0].alpha,
    &b = bodies[first ? 2 : 1].alpha;
    Real most = 0;
    for (Index c = 0; c < crowd.mesh.n_cells; ++c)
      if (a[c] > 0 && b[c] > 0) wisp[c] = 1e-10, b[c] = 1.1 - a[c], most = a[c] + b[c];
    EXPECT_GT(global_max(most), 1.09);
    crowd.solver.step(1e-3);
    most = 0;
    for (Index c = 0; c < crowd.mesh.n_owned; ++c) most = std::max(most, a[c] + b[c]);
    EXPECT_NEAR(crowd.solver.overlap(), global_max(most) - 1, 1e-9) << first;
  }
}

// Where both solids fill more than half of a cell, the mean of their gradients counts.
TEST(Overlap, GradientsDoNotDependOnTheOrder) {
  Crowd crowd(true, std::array{Vec3{0.5, 0.5, 0}, Vec3{0.82, 0.5, 0}});
  auto& bodies = crowd.solver.bodies();
  for (Body& body : bodies) body.alpha.fill(0.6), body.alpha_mid.fill(0.6);
  CellField<Tensor> flow(crowd.mesh), L(crowd.mesh);
  SideGradients gradients(crowd.mesh);
  for (const bool swapped : {false, true}) {
    gradients.begin(flow);
    for (const std::size_t i : {swapped ? 1U : 0U, swapped ? 0U : 1U}) {
      const Real a = 1 + static_cast<Real>(i);
      L.fill({a, a, a, a, a, a, a, a, a});
      gradients.keep(L, bodies[i]);
    }
    L.assign(flow);
    gradients.merge(L, bodies);
    Real common = 0;
    for (Index c = 0; c < crowd.mesh.n_owned; ++c) {
      const auto lists = [&](const Body& body) { return body.strain_cells().listed()[c] != 0; };
      if (!std::ranges::all_of(bodies, lists)) continue;
      EXPECT_EQ(L[c].xx, 1.5);
      common = 1;
    }
    EXPECT_GT(global_max(common), 0);
  }
}

}  // namespace
}  // namespace fsi
