#pragma once
// Films of fluid that are thinner than the mesh resolves.

#include <cstddef>
#include <string>

#include "libfsi/solver/solver.hpp"

namespace fsi {

/// What a solid is so near to that the film of fluid between them is not resolved.
struct ThinFilms {
  std::string wall;   ///< a patch of type wall, with a film of less than half a cell; "": none
  std::string solid;  ///< another solid, with a film of less than a cell; "": none
};

/// Collective. The thin films of solid i (doc/theory/walls.md). A solid that is bonded to a wall
/// has no film there, and cells beside its bond may fill as it strains: its walls do not count.
ThinFilms thin_films(std::size_t i, const Solver& solver);

}  // namespace fsi
