#pragma once
// The part of a stress that a jump of the pressure bears at the solid's surface.

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::solid {

/// force_c += level_c and balance_f -= (level)_f . d on the band's cells and internal faces,
/// level_c = sum_f g_cf s (alpha_n - alpha_c): the cells' share of a jump s of the normal stress
/// whose rise s (alpha_N - alpha_P) balance has. level: owned and halo.
inline void add_level(CellField<Vec3>& force, FaceField<Real>& balance,
                      const CellField<Vec3>& level, const FaceWeights& weights, const Mesh& mesh,
                      const Band& band) {
  for (const Index c : band.cells()) force[c] += level[c];
  for (const Index f : band.faces()) {
    if (f >= mesh.n_internal) continue;
    const Real lambda = weights.lambda[f];
    balance[f] -=
        dot((1 - lambda) * level[mesh.owner[f]] + lambda * level[mesh.neighbour[f]], mesh.d[f]);
  }
}

}  // namespace fsi::solid
