#include "libfsi/run/thin_film.hpp"

#include <algorithm>
#include <variant>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/extension.hpp"

namespace fsi {
namespace {

/// Collective. The first wall with a cell that the solid fills to a half.
std::string nearest_wall(const Body& body, const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  if (body.bonded_faces + body.sliding_faces > 0) return "";
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    const Patch& patch = mesh.patches[i];
    if (!std::holds_alternative<Wall>(solver.conditions()[i])) continue;
    bool filled = false;
    for (Index f = patch.begin; f < patch.end; ++f)
      filled = filled || body.alpha[mesh.owner[f]] >= solid::alpha_known;
    if (global_max(filled ? 1.0 : 0.0) > 0) return patch.name;
  }
  return "";
}

/// Collective. The first other solid that shares a cell with it.
std::string nearest_solid(const Body& body, const Solver& solver) {
  constexpr Real least = 0.05;  // of a cell
  for (const Body& other : solver.bodies()) {
    if (&other == &body) continue;
    bool shared = false;
    for (Index c = 0; c < body.mesh.n_owned; ++c)
      shared = shared || (body.alpha[c] > least && other.alpha[c] > least);
    if (global_max(shared ? 1.0 : 0.0) > 0) return other.name;
  }
  return "";
}

}  // namespace

ThinFilms thin_films(std::size_t i, const Solver& solver) {
  const Body& body = solver.bodies()[i];
  return {.wall = nearest_wall(body, solver), .solid = nearest_solid(body, solver)};
}

}  // namespace fsi
