#pragma once
// What the settling disc and sphere share: the way to their speed.

#include <gtest/gtest.h>

#include <algorithm>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi::test {

/// Mean velocity along x of the solver's solid at the time `end`, in steps of a part of it or as
/// the limits have it; 0 where a step fails.
inline Real settled_speed(Solver& solver, Real end, int parts) {
  const Mesh& mesh = solver.mesh();
  while (solver.state().t < end) {
    const Real dt =
        std::min({end / parts, solver.advective_dt(0.5), solver.carried_dt(), solver.elastic_dt()});
    EXPECT_GT(solver.advance(dt), 0) << solver.report().failure;
    if (!solver.report().failure.empty()) return 0;
  }
  Sum moved, volume;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    moved.add(mesh.V[c] * solver.body()->alpha[c] * solver.state().u[c].x);
    volume.add(mesh.V[c] * solver.body()->alpha[c]);
  }
  return moved.total() / volume.total();
}

}  // namespace fsi::test
