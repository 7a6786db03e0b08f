#include "libfsi/solid/alternation.hpp"

#include "libfsi/solid/simplex_zone.hpp"

namespace fsi::solid {

std::vector<Real> lost_part(const FaceWeights& weights, const Mesh& mesh, Real in_zone) {
  constexpr Real rounding = 1e-8;
  const SimplexZone zone(mesh);
  std::vector<Real> part(static_cast<std::size_t>(mesh.n_owned), 0);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    for (const Index f : mesh.cell_faces[c])
      if (f < mesh.n_internal && weights.tangent(f, mesh) > rounding)
        part[c] = std::clamp(2 * weights.tangent(f, mesh), part[c], Real{1});
    if (zone.has(c)) part[c] = in_zone;
  }
  return part;
}

}  // namespace fsi::solid
