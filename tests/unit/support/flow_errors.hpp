#pragma once
// Errors of a computed flow against an exact one.

#include "libfsi/analysis/measures.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi::test {

struct Errors {
  Real u = 0, p = 0;
};

/// L2 errors against exact fields; the mean of the pressure difference is taken out.
template <class U, class P>
Errors errors(const Solver& solver, const U& u, const P& p) {
  const Mesh& mesh = solver.mesh();
  const State& s = solver.state();
  Sum mean;
  for (Index c = 0; c < mesh.n_owned; ++c) mean.add(mesh.V[c] * (s.p[c] - p(mesh.C[c])));
  const Real shift = mean.total() / mesh.total_volume;
  return {analysis::norms(mesh, [&](Index c) { return s.u[c] - u(mesh.C[c]); }).l2,
          analysis::norms(mesh, [&](Index c) { return s.p[c] - p(mesh.C[c]) - shift; }).l2};
}

/// The same against u(x, t) and p(x, t) after a step of dt, with u as a part of the exact one. The
/// pressure of a step belongs to its middle, t - dt / 2.
template <class U, class P>
Errors relative_errors(const Solver& solver, const U& u, const P& p, Real dt) {
  const Mesh& mesh = solver.mesh();
  const Real t = solver.state().t;
  const auto u_now = [&](const Vec3& x) { return u(x, t); };
  Errors off = errors(solver, u_now, [&](const Vec3& x) { return p(x, t - dt / 2); });
  off.u /= analysis::norms(mesh, [&](Index c) { return u_now(mesh.C[c]); }).l2;
  return off;
}

}  // namespace fsi::test
