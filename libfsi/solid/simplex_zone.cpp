#include "libfsi/solid/simplex_zone.hpp"

#include <algorithm>

#include "libfsi/core/parallel.hpp"

namespace fsi::solid {

SimplexZone::SimplexZone(const Mesh& mesh) : within_(mesh), near_(mesh) {
  bool none = true, whole = true;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const auto simplex = [&](Index n) { return mesh.simplex(n); };
    if (!simplex(c) && std::ranges::none_of(mesh.cell_neighbours[c], simplex)) {
      whole = false;
      continue;
    }
    within_[c] = 1;
    none = false;
  }
  mesh.halo.update(within_);
  const auto is_within = [&](Index n) { return has(n); };
  for (Index c = 0; c < mesh.n_owned; ++c)
    near_[c] = has(c) || std::ranges::any_of(mesh.cell_neighbours[c], is_within) ? 1 : 0;
  mesh.halo.update(near_);
  any_ = !all_of_ranks(none);
  all_ = all_of_ranks(whole);
}

}  // namespace fsi::solid
