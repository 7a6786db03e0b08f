#pragma once
// The part of the pressure that balances what the projection does to the implicit viscous term.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::flow {

/// p_c -= chi mu_c div u*, mu_c the least theta_f mu + kappa of the cell's faces: the effect of the
/// implicit viscous term on the correction grad q. chi = 1/2, less in cells of poor shape.
class ViscousPressure {
 public:
  /// mesh: must outlive it. mirrors: [n_boundary] 1 on planes of symmetry, where a cell has an
  /// image; empty: there are none.
  ViscousPressure(const Mesh& mesh, const FaceWeights& weights,
                  const std::vector<char>& mirrors = {});

  /// Collective. div: of the predicted flux, owned. p: owned and halo.
  void add(CellField<Real>& p, const CellField<Real>& div, const FaceField<Real>& mu,
           const FaceField<Real>& kappa, const FaceField<Real>& theta) const;

 private:
  const Mesh& mesh_;
  std::vector<Real> chi_;  // [n_owned]
};

}  // namespace fsi::flow
