// What a Watch tells of solids that leave the mesh.

#include <algorithm>
#include <variant>

#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/run/thin_film.hpp"
#include "libfsi/run/told.hpp"
#include "libfsi/run/watch.hpp"

namespace fsi {
namespace {

/// Collective. Whether cells at openings, of which all but walls and planes of symmetry are, hold
/// some of the solid.
bool is_at_opening(const Body& body, const Solver& solver) {
  constexpr Real least = 0.01;  // of a cell
  const Mesh& mesh = solver.mesh();
  Real most = 0;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    const Condition& condition = solver.conditions()[i];
    if (std::holds_alternative<Wall>(condition) || std::holds_alternative<Slip>(condition))
      continue;
    const Patch& patch = mesh.patches[i];
    for (Index f = patch.begin; f < patch.end; ++f)
      most = std::max(most, body.alpha[mesh.owner[f]]);
  }
  return global_max(most) > least;
}

/// Collective. Whether the solid has left in part, and what is left of it is off the openings.
bool comes_back(const Body& body, const Solver& solver) {
  constexpr Real part = 0.02;  // less, out or in the mesh, is a wisp
  const Real out = body.volume_out / body.filled.volume;
  return out > part && out < 1 - part && !is_at_opening(body, solver);
}

}  // namespace

void Watch::leaving(const Solver& solver) {
  const Real t = solver.state().t;
  for (std::size_t i = 0; i < said_.size(); ++i) {
    const Body& body = solver.bodies()[i];
    if (!leaves(body)) continue;
    const bool begins = !said_[i].leaving, ends = body.gone != 0 && !said_[i].left;
    said_[i].leaving = true, said_[i].left = body.gone != 0;
    if (begins)
      say("notice", name_of(body) +
                        print(" leaves the mesh from t = %g on: column volume_out of ", t) +
                        table_of(body));
    if (ends)
      say("notice",
          "the last of the " + name_of(body) +
              print(" left the mesh at t = %g; the rest, %.2g %% of it, a volume of %.3g, was "
                    "taken out and counts in volume_out",
                    t, 100 * body.residue / body.filled.volume, body.residue));
    if (!said_[i].left && !said_[i].back && comes_back(body, solver)) {
      said_[i].back = true;
      say("warning",
          print("at t = %.4g no opening cuts ", t) + name_of(body) +
              print(" any more: %.2g %% of it are in the mesh and move on as a body of their own, "
                    "the rest went out and does not come back; a longer vessel behind the opening "
                    "keeps it whole",
                    100 * (1 - body.volume_out / body.filled.volume)));
    }
  }
}

void Watch::resume(const Solver& solver) {
  for (std::size_t i = 0; i < said_.size(); ++i) {
    const Body& body = solver.bodies()[i];
    said_[i].leaving = leaves(body), said_[i].left = body.gone != 0;
    said_[i].back = said_[i].leaving && comes_back(body, solver);
    const ThinFilms thin = thin_films(i, solver);
    said_[i].sliding = !thin.wall.empty();
    told_of_touch_ = told_of_touch_ || !thin.other.empty();
  }
}

}  // namespace fsi
