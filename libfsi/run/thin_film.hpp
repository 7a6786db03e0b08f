#pragma once
// Films of fluid that are thinner than the mesh resolves.

#include <cstddef>
#include <string>

#include "libfsi/solver/solver.hpp"

namespace fsi {

/// What a solid is so near to that the film of fluid between them is not resolved.
struct ThinFilms {
  std::string wall;  ///< a patch of type wall, with a film of less than half a cell; "": none
  /// Another solid, or its own image at a plane of symmetry, with a film of less than a cell, as a
  /// sentence names it; "": none.
  std::string other;
};

/// Collective. The thin films of solid i (doc/theory/walls.md). A solid that is bonded to a wall
/// has no film there, and cells beside its bond may fill as it strains: its walls do not count. At
/// a plane that cuts the solid there is no film to its image.
ThinFilms thin_films(std::size_t i, const Solver& solver);

}  // namespace fsi
