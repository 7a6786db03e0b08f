#include "libfsi/run/thin_film.hpp"

#include <algorithm>
#include <limits>
#include <variant>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/extension.hpp"

namespace fsi {
namespace {

constexpr Real none = std::numeric_limits<Real>::max();

/// The number of the first wall that has a cell which the body fills to a half; `none` without one.
/// The walls that it stood on at the start do not count.
Real nearest_wall(const Body& body, const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    if (!std::holds_alternative<Wall>(solver.conditions()[i]) || body.stood_on[i] != 0) continue;
    const Patch& patch = mesh.patches[i];
    for (Index f = patch.begin; f < patch.end; ++f)
      if (body.alpha[mesh.owner[f]] >= solid::alpha_known) return static_cast<Real>(i);
  }
  return none;
}

/// The number of the first other solid that has a cell of the body, too; `none` without one. Face
/// neighbours of which each is filled to a half by one of them count as well.
Real nearest_solid(const Body& body, const Solver& solver) {
  constexpr Real least = 0.05;  // of a cell
  for (std::size_t i = 0; i < solver.bodies().size(); ++i) {
    const Body& other = solver.bodies()[i];
    if (&other == &body) continue;
    const auto near = [&](Index c) {
      if (body.alpha[c] > least && other.alpha[c] > least) return true;
      return body.alpha[c] >= solid::alpha_known &&
             std::ranges::any_of(body.mesh.cell_faces[c], [&](Index f) {
               const Index n = beyond(body.mesh, f, c);
               return n >= 0 && other.alpha[n] >= solid::alpha_known;
             });
    };
    if (std::ranges::any_of(body.band.cells(), near)) return static_cast<Real>(i);
  }
  return none;
}

}  // namespace

ThinFilms thin_films(std::size_t i, const Solver& solver) {
  const Body& body = solver.bodies()[i];
  const Real wall = global_min(nearest_wall(body, solver));
  const Real other = global_min(nearest_solid(body, solver));
  const auto number = [](Real of) { return static_cast<std::size_t>(of); };
  return {.wall = wall < none ? solver.mesh().patches[number(wall)].name : "",
          .solid = other < none ? solver.bodies()[number(other)].name : ""};
}

}  // namespace fsi
