#include "libfsi/solid/carrier.hpp"

namespace fsi::solid {

void gradient(CellField<SymGradient>& grad, const CellField<SymTensor>& T,
              const GradientStencil& stencil, const Mesh& mesh, std::span<const Index> cells) {
  for (const Index c : cells) {
    SymGradient sum;
    for (const Index f : mesh.cell_faces[c]) {
      if (f >= mesh.n_internal) continue;
      const bool owner = mesh.owner[f] == c;
      const SymTensor dT = T[owner ? mesh.neighbour[f] : mesh.owner[f]] - T[c];
      const Vec3& g = owner ? stencil.owner[f] : stencil.neighbour[f];
      sum.x += g.x * dT, sum.y += g.y * dT, sum.z += g.z * dT;
    }
    grad[c] = sum;
  }
}

}  // namespace fsi::solid
