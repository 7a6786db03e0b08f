#pragma once
// How far a cut cell reaches to either side of the surface: what a kink there adds to its mean.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// Means over cut cells of the distance s = n . (x - x_S) from their plane, times n; zero
/// elsewhere. With q linear, q_S on the solid's side and q_S + j s beyond, the mean of a cell is
///   q_S(x_c) + j |beyond|,    or by the fluid's side, q_F = q_S + j s,    q_F(x_c) + j |behind|.
class Reach {
 public:
  explicit Reach(const Mesh& mesh) : beyond(mesh), behind(mesh), mesh_(mesh), cell_(mesh.dim) {}

  /// Collective. interface: of this rank's cells.
  void set(const Interface& interface);

  CellField<Vec3> beyond;  ///< n mean(max(0, s)); owned and halo
  CellField<Vec3> behind;  ///< n mean(max(0, -s)); owned and halo

 private:
  const Mesh& mesh_;
  std::vector<Index> cells_;
  geometry::Polytope cell_;
};

}  // namespace fsi::vof
