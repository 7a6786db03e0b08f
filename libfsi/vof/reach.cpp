#include "libfsi/vof/reach.hpp"

#include <algorithm>

namespace fsi::vof {

void Reach::set(const Interface& interface) {
  for (const Index c : cells_) beyond[c] = behind[c] = {};
  cells_ = interface.cells;
  for (const Index c : cells_) {
    const Piece& piece = interface.piece[c];
    gather(cell_, mesh_, c);
    // mean(max(0, s)) - mean(max(0, -s)) = mean(s) = -level
    const Real level = dot(piece.n_hat, piece.centre - mesh_.C[c]);
    const Real above = geometry::mean_above(cell_, {piece.n_hat, level});
    beyond[c] = above * piece.n_hat;
    behind[c] = std::max(Real{0}, above + level) * piece.n_hat;
  }
  mesh_.halo.update(beyond);
  mesh_.halo.update(behind);
}

}  // namespace fsi::vof
