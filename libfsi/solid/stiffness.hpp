#pragma once
// How stiff the solid is to a step, and what makes a step larger than that stable.

#include <span>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::solid {

/// lambda_c = alpha times the largest eigenvalue of B: largest of aB, on the listed cells.
void largest_stretch(CellField<Real>& lambda, const CellField<SymTensor>& aB,
                     std::span<const Index> cells);

/// Time in which the elastic shear wave passes a cell: the least h (rho / (G lambda))^(1/2) over
/// the cells, h = V / max |Sf|, lambda at least 1. [Matsumiya25] (15) This rank's cells only.
Real elastic_time(const CellField<Real>& lambda, Real G, Real rho, const Mesh& mesh,
                  std::span<const Index> cells);

/// kappa_f = 0.3 dt G min(lambda, 20), lambda linear between the cells: the scalar operator
/// div(kappa grad (u* - u^n)) stands in for the change of the elastic stress over a step. With
/// leapfrog that is div(dt G B . grad u) by div u = 0, and a share of 1/4 of it or more makes the
/// pair stable for any dt: w^2 dt^2 / (1 + c w^2 dt^2) <= 4. It vanishes with the change of u over
/// a step, and so does not touch second order. lambda: owned and halo. kappa: zero on all faces
/// outside the band of this and the last call.
class Stiffness {
 public:
  explicit Stiffness(const Mesh& mesh) : mesh_(mesh) {}

  void apply(FaceField<Real>& kappa, const CellField<Real>& lambda, Real G, Real dt,
             const FaceWeights& weights, const Band& band);
  /// kappa = 0.
  void clear(FaceField<Real>& kappa);

 private:
  const Mesh& mesh_;
  std::vector<Index> last_faces_;
};

}  // namespace fsi::solid
