#pragma once
// What a kink at the surface adds to the value of a cut cell.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// A velocity u + j max(0, s), s = n . (x - x_S) and u linear, bears a traction mu j n . S that the
/// faces carry by the part of solid in the prism they sweep (face_fraction). That part is not the
/// one of the line between the centres. So what balances in a cut cell is u + j phi,
///   sum_f g (phi_N - phi - (1 - alpha_f) n . d) = 0,    phi_N = max(0, s_N) beside it,
/// One step from the neighbours' exact values gives phi, with alpha_f by the cell's own plane. It
/// is max(0, s) where the plane lies along faces, elsewhere off by some hundredths of a cell to
/// either side.
class KinkProfile {
 public:
  /// mesh must outlive it.
  explicit KinkProfile(const Mesh& mesh)
      : normal(mesh), solid_side(mesh), fluid_side(mesh), mesh_(mesh) {}

  /// Collective. interface: of this rank's cells.
  void set(const Interface& interface, const FaceWeights& weights);

  CellField<Vec3> normal;      ///< n; zero in cells that are not cut; owned and halo
  CellField<Real> solid_side;  ///< phi: what j adds by the solid's side; owned and halo
  CellField<Real> fluid_side;  ///< phi - s: what it adds by the fluid's side; owned and halo

 private:
  const Mesh& mesh_;
  std::vector<Index> cells_;
};

}  // namespace fsi::vof
