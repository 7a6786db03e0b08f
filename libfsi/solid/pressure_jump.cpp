#include "libfsi/solid/pressure_jump.hpp"

#include <cmath>

#include "libfsi/solid/inward_normal.hpp"

namespace fsi::solid {

void advect_pressure_jump(CellField<Real>& p, const CellField<Real>& alpha_mid,
                          const CellField<Real>& alpha, const CellField<SymTensor>& T, Real G,
                          const Mesh& mesh, std::span<const Index> cells,
                          const SymmetryFaces& symmetry) {
  constexpr Real negligible = 1e-12;
  for (const Index c : cells) {
    const Real gained = 2 * (alpha[c] - alpha_mid[c]);
    if (std::abs(gained) < negligible) continue;
    const Vec3 m = inward_normal(alpha, mesh, c, symmetry);
    p[c] += dot(m, dot(G * dev(T[c]), m)) * gained;
  }
}

}  // namespace fsi::solid
