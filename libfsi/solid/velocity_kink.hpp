#pragma once
// The kink of the velocity at the surface of a solid, at the faces that the surface passes.

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/kinks.hpp"
#include "libfsi/solid/simplex_zone.hpp"

namespace fsi::solid {

/// Where the surface is at a face, and the velocity gradient beside it.
struct SurfaceAtFaces {
  const FaceField<Real>& alpha_f;  ///< the solid's part of the line between the cells
  const CellField<Real>& alpha;    ///< fraction of the solid; owned and halo
  const CellField<Tensor>& L;      ///< quasi-Green velocity gradient, on the band and halo
};

/// Whether the surface passes between the cells of internal face f.
bool crosses(const CellField<Real>& alpha, Index f, const Mesh& mesh);

/// Adds the faces of the band between a cell with alpha of at least 1/2 and one with less,
///   u_f = (u_P + u_N) / 2 - min(alpha_f, 1 - alpha_f) (L_N - L_P) . d.
/// On the line between the cells u is linear on either side of the surface, and L . d changes by
/// the jump there. Each quasi-Green gradient has a neighbour on the other side, so that L_N - L_P
/// is half the jump. The midpoint lies on the longer side. Faces of the simplex zone are left out.
void add_kinks(Kinks& kinks, const SurfaceAtFaces& surface, const SimplexZone& zone,
               const Band& band, const Mesh& mesh);

}  // namespace fsi::solid
