#pragma once
// The density where solids are denser or lighter than the fluid.

#include <span>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::flow {

/// The inertia of faces and cells. Where all that moves has one acceleration a, the pressure rises
/// by rho_f a . d over a face. What the cells make of it is their mean of rho_f a. They move
/// together with the faces if that mean is also their inertia, component by component,
///
///   rho_f = rho_0 + sum_i (rho_i - rho_0) alpha_f,i
///   D_c,k = rho_c + (1/V) sum_f lambda_cf (rho_f - rho_c) d_k S_k,
///
/// rho_c the density of the cell by its fractions. With alpha_f of the prism between two centres
/// the mass of all cells and of all faces is the same on quadrilaterals and hexahedra.
class Density {
 public:
  /// rho_0: that of the fluid.
  Density(const Mesh& mesh, const FaceWeights& weights, Real rho_0);

  /// The fluid's everywhere.
  void clear();
  /// Adds a solid of that density by its fractions of cells (owned and halo) and of the listed
  /// faces.
  void add(Real rho, const CellField<Real>& alpha, const FaceField<Real>& alpha_f,
           std::span<const Index> faces);
  /// Collective. Sets D, owned and halo, from what was added.
  void finish();

  /// Density of the fluid.
  Real rho_0() const { return rho_0_; }
  /// rho_f.
  const FaceField<Real>& of_face() const { return of_face_; }
  /// rho_c.
  const CellField<Real>& of_cell() const { return of_cell_; }
  /// D.
  const CellField<Vec3>& inertia() const { return inertia_; }
  /// v / D in cell c.
  Vec3 divided(const Vec3& v, Index c) const {
    const Vec3& D = inertia_[c];
    return {v.x / D.x, v.y / D.y, v.z / D.z};
  }

 private:
  const Mesh& mesh_;
  const FaceWeights& weights_;
  Real rho_0_, least_, most_;
  FaceField<Real> of_face_;
  CellField<Real> of_cell_;
  CellField<Vec3> inertia_;
};

/// What a force N (per volume, owned and halo) makes of the face flux in the place of what it makes
/// of the cells', times rho_f:
///   U(N)_f . S - rho_f U(N / D)_f . S,   U with the weights of `predict_flux`.
Real flux_of_force(const Density& density, const CellField<Vec3>& N, const FaceWeights& weights,
                   const Mesh& mesh, Index f);

}  // namespace fsi::flow
