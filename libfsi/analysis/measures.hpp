#pragma once
// Single numbers and derived fields of a state. Collective where they return a number.

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::analysis {

/// A check of the strain: the exact B has det B = 1 and positive eigenvalues.
struct Health {
  /// Extremes of det B and of the smallest eigenvalue.
  Real det_min = 1, det_max = 1, eigenvalue_min = 1;
};

/// Extremes over the owned cells of all ranks with alpha > 0.5; all 1 where there are none.
Health health(const CellField<SymTensor>& B, const CellField<Real>& alpha, const Mesh& mesh);

/// sum rho |u|^2 V / 2.
Real kinetic_energy(const CellField<Real>& rho, const CellField<Vec3>& u, const Mesh& mesh);

/// Q = (|W|^2 - |D|^2) / 2, W and D the antisymmetric and symmetric part of L   [Hunt88],
/// [Matsumiya25] (25). Every cell for which L is set, owned and halo.
void q_criterion(CellField<Real>& Q, const CellField<Tensor>& L);

/// 2 D : D, D the symmetric part of L: what a viscosity of 1 dissipates per volume and time.
Real twice_strain_squared(const Tensor& L);
/// integral 2 mu D : D, D the symmetric part of L: the energy that viscosity dissipates per time.
Real dissipation(const CellField<Real>& mu, const CellField<Tensor>& L, const Mesh& mesh);

/// Volume-weighted means of an error: L1 = <|e|>, L2 = <e^2>^(1/2), Linf = max |e|.
struct Norms {
  /// The three means.
  Real l1 = 0, l2 = 0, linf = 0;
};

///@{
/// |e|.
inline Real magnitude(Real e) { return std::abs(e); }
inline Real magnitude(const Vec3& e) { return norm(e); }
///@}

/// Collective. Norms over all cells of error(c), a Real or Vec3, c an owned cell.
template <class Error>
Norms norms(const Mesh& mesh, const Error& error) {
  Sum first, second;
  Real largest = 0;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real e = magnitude(error(c));
    first.add(e * mesh.V[c]), second.add(e * e * mesh.V[c]);
    largest = std::max(largest, e);
  }
  return {first.total() / mesh.total_volume, std::sqrt(second.total() / mesh.total_volume),
          global_max(largest)};
}

}  // namespace fsi::analysis
