#include "libfsi/solid/velocity_kink.hpp"

#include <algorithm>

#include "libfsi/solid/extension.hpp"

namespace fsi::solid {

bool crosses(const CellField<Real>& alpha, Index f, const Mesh& mesh) {
  return (alpha[mesh.owner[f]] >= alpha_known) != (alpha[mesh.neighbour[f]] >= alpha_known);
}

void add_kinks(Kinks& kinks, const SurfaceAtFaces& surface, const SimplexZone& zone,
               const Band& band, const Mesh& mesh) {
  kinks.reserve(band.faces().size());
  for (const Index f : band.faces()) {
    if (f >= mesh.n_internal || !crosses(surface.alpha, f, mesh)) continue;
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    if (zone.has(P) || zone.has(N)) continue;
    const Real part = surface.alpha_f[f];
    kinks.add(f, -std::min(part, 1 - part) * dot(surface.L[N] + -1.0 * surface.L[P], mesh.d[f]));
  }
}

}  // namespace fsi::solid
