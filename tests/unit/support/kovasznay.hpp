#pragma once
// Kovasznay's steady flow behind a grid, at a Reynolds number of 40.

#include <cmath>
#include <numbers>

#include "libfsi/solver/solver.hpp"
#include "tests/unit/support/flow_errors.hpp"

namespace fsi::test {

/// The flow in the unit square, whose middle is the origin of X and Y [Kovasznay48], with rho = 1:
///   u = (1 - e^(lambda X) cos(2 pi Y), lambda / (2 pi) e^(lambda X) sin(2 pi Y)),
///   p = (1 - e^(2 lambda X)) / 2,
///   lambda = 1 / (2 nu) - (1 / (4 nu^2) + 4 pi^2)^(1/2).
namespace kovasznay {

constexpr Real pi = std::numbers::pi, nu = 1.0 / 40;
inline const Real lambda = 1 / (2 * nu) - std::sqrt(1 / (4 * nu * nu) + 4 * pi * pi);

inline Vec3 u(const Vec3& x) {
  const Real X = x.x - 0.5, Y = x.y - 0.5;
  return {1 - std::exp(lambda * X) * std::cos(2 * pi * Y),
          lambda / (2 * pi) * std::exp(lambda * X) * std::sin(2 * pi * Y), 0};
}

inline Real p(const Vec3& x) { return (1 - std::exp(2 * lambda * (x.x - 0.5))) / 2; }

/// The errors at t = 3 of a run with steps of dt that starts with u and has it on all four sides.
inline Errors run(const Mesh& mesh, Real dt) {
  const FixedVelocity exact{[](const Vec3& x, Real) { return u(x); }};
  Solver solver(
      mesh, {.rho = 1, .mu_f = nu},
      {.conditions = {{"left", exact}, {"right", exact}, {"bottom", exact}, {"top", exact}}});
  solver.start(u);
  for (int i = 0; i * dt < 3; ++i) solver.step(dt);
  return errors(solver, u, p);
}

}  // namespace kovasznay
}  // namespace fsi::test
