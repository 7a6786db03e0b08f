// A vessel that divides in two, of tetrahedra, in creeping flow: how the flow splits between
// outlets of different resistance, as the network of resistances has it.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/read.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

constexpr Real mu = 1;

struct Split {
  Real left, right, p_left, p_right;  ///< flow rates out, pressures at the outlets
  Real net;                           ///< largest sum over all patches in a step
};

Real mean_pressure(const Solver& solver, const Patch& patch) {
  const Mesh& mesh = solver.mesh();
  Sum p, area;
  for (Index f = patch.begin; f < patch.end; ++f) {
    p.add(norm(mesh.Sf[f]) * solver.state().p[mesh.owner[f]]), area.add(norm(mesh.Sf[f]));
  }
  return p.total() / area.total();
}

Split steady(const Mesh& mesh, const Condition& left, const Condition& right) {
  Solver solver(
      mesh, {.rho = 0.05, .mu_f = mu},
      {.conditions = {{"inlet", FlowRate{1}}, {"left", left}, {"right", right}, {"wall", Wall{}}}});
  solver.start([](const Vec3&) { return Vec3{}; });
  Real net = 0;
  for (int i = 0; i < 60; ++i) {
    solver.step(3e-3);
    Sum sum;
    for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) sum.add(solver.state().phi[f]);
    net = std::max(net, std::abs(sum.total()));
  }
  const auto rate = [&](const char* name) {
    const Patch& patch = mesh.patch(name);
    Sum sum;
    for (Index f = patch.begin; f < patch.end; ++f) sum.add(solver.state().phi[f]);
    return sum.total();
  };
  return {rate("left"), rate("right"), mean_pressure(solver, mesh.patch("left")),
          mean_pressure(solver, mesh.patch("right")), net};
}

// With p_j the pressure where the branches meet, r that of a branch, the same for both,
//   p_j = (r + R_left) Q_left = (r + R_right) Q_right.
// r is what falls off along a branch while the other is closed.
TEST(Junction, OutletsOfDifferentResistanceSplitTheFlowAsTheirNetwork) {
  const Mesh mesh = read_mesh({.file = std::string(FSI_MESHES) + "/junction.msh", .periodic = {}});
  const Split closed = steady(mesh, Opening{0}, FlowRate{0});
  const Real r = (closed.p_right - closed.p_left) / closed.left;
  for (const Real R_right : {50.0, 200.0, 1000.0}) {
    const Real R_left = 50;
    const Split split = steady(mesh, Opening{.pressure = 0, .load = {.proximal = R_left}},
                               Opening{.pressure = 0, .load = {.proximal = R_right}});
    const Real expected = (r + R_right) / (2 * r + R_left + R_right);
    std::printf(
        "junction, branches %.1f, outlets %g and %g: left %.4f of the flow, network %.4f; "
        "sum of the patches at most %.1e\n",
        r, R_left, R_right, split.left, expected, split.net);
    EXPECT_NEAR(split.left / expected, 1, 0.01);
    EXPECT_NEAR(split.left + split.right, 1, 1e-12);
    EXPECT_LE(split.net, 1e-12);
  }
}

}  // namespace
}  // namespace fsi
