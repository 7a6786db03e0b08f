#pragma once
// The value l_+ that a kink at the surface adds to a cut cell.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// Let l = n_hat . (x - x_S) be the distance from the surface, positive in the fluid. A velocity u
/// + j max(0, l), u linear, has a kink with the traction mu j n_hat . S. The faces take this
/// traction by the part of solid alpha_f in the prism that they sweep (face_fraction), not by the
/// part on the line between the centres. So a balanced cut cell has u + j l_+, with
///   sum_f g (max(0, l_N) - l_+ - (1 - alpha_f) n_hat . d) = 0,   l_N that of the cell beyond.
/// alpha_f follows from the cell's own plane. l_+ is max(0, l) if the plane lies along faces, and
/// differs from it by some hundredths of a cell otherwise.
class KinkProfile {
 public:
  /// mesh must outlive it.
  explicit KinkProfile(const Mesh& mesh)
      : normal(mesh), solid_side(mesh), fluid_side(mesh), mesh_(mesh) {}

  /// Collective. interface: of this rank's cells. symmetry: faces beyond which a cell has an image.
  void set(const Interface& interface, const FaceWeights& weights,
           const SymmetryFaces& symmetry = {});

  CellField<Vec3> normal;      ///< n_hat; zero in cells that are not cut; owned and halo
  CellField<Real> solid_side;  ///< l_+, for the solid's side; owned and halo
  CellField<Real> fluid_side;  ///< l_+ - l, for the fluid's side; owned and halo

 private:
  const Mesh& mesh_;
  std::vector<Index> cells_;
};

}  // namespace fsi::vof
