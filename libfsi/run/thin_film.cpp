#include "libfsi/run/thin_film.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <variant>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/extension.hpp"

namespace fsi {
namespace {

constexpr Real none = std::numeric_limits<Real>::max();

/// The number of the first patch of a kind that has a cell which the body fills to a half; `none`
/// without one. Walls that it stood on at the start and faces on planes that cut it do not count.
template <class Kind>
Real nearest_patch(const Body& body, const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    if (!std::holds_alternative<Kind>(solver.conditions()[i])) continue;
    if (std::is_same_v<Kind, Wall> && body.stood_on[i] != 0) continue;
    const Patch& patch = mesh.patches[i];
    for (Index f = patch.begin; f < patch.end; ++f)
      if (body.alpha[mesh.owner[f]] >= solid::alpha_known && !body.cut.has(f, mesh))
        return static_cast<Real>(i);
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
  const Real wall = global_min(nearest_patch<Wall>(body, solver));
  const Real image = global_min(nearest_patch<Slip>(body, solver));
  const Real other = global_min(nearest_solid(body, solver));
  const auto patch = [&](Real of) { return solver.mesh().patches[static_cast<std::size_t>(of)]; };
  ThinFilms thin;
  if (wall < none) thin.wall = patch(wall).name;
  if (other < none)
    thin.other = "solid " + solver.bodies()[static_cast<std::size_t>(other)].name;
  else if (image < none)
    thin.other = "its image at " + patch(image).name;
  return thin;
}

}  // namespace fsi
