#include "libfsi/vof/kink_profile.hpp"

#include <algorithm>

#include "libfsi/vof/face_fraction.hpp"

namespace fsi::vof {

void KinkProfile::set(const Interface& interface, const FaceWeights& weights,
                      const SymmetryFaces& symmetry) {
  for (const Index c : cells_) normal[c] = {}, solid_side[c] = fluid_side[c] = 0;
  cells_ = interface.cells;
  for (const Index c : cells_) {
    const Piece& piece = interface.piece[c];
    const Real s = dot(piece.n_hat, mesh_.C[c] - piece.centre), own = std::max(Real{0}, s);
    Real sum = 0, whole = 0;
    for (const Index f : mesh_.cell_faces[c]) {
      const bool internal = f < mesh_.n_internal, mirrored = symmetry.has(f, mesh_);
      const Vec3 d = mirrored ? to_image(mesh_, f) : mesh_.d[f];
      const Real g = mirrored ? norm2(mesh_.Sf[f]) / dot(mesh_.Sf[f], d) : weights.g[f];
      whole += g;
      if (!internal && !mirrored) continue;
      const Real lambda = internal ? weights.lambda[f] : 0.5, along = dot(piece.n_hat, d);
      const Real solid = swept_part(mesh_, f, c, piece, lambda * along, (lambda - 1) * along);
      const Real rise = mesh_.owner[f] == c ? along : -along;
      sum += g * (std::max(Real{0}, s + rise) - own - (1 - solid) * rise);
    }
    normal[c] = piece.n_hat;
    solid_side[c] = own + sum / whole;
    fluid_side[c] = solid_side[c] - s;
  }
  mesh_.halo.update(normal);
  mesh_.halo.update(solid_side);
  mesh_.halo.update(fluid_side);
}

}  // namespace fsi::vof
