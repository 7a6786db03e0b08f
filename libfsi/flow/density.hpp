#pragma once
// The density, if solids are denser or lighter than the fluid.

#include <span>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi::flow {

/// The inertia of faces and cells. If everything moves with one acceleration a, the pressure rises
/// by rho_f a . d over a face, and the force on a cell is the mean of rho_f a over its faces. Cells
/// and faces accelerate alike if that mean is also the inertia of the cell, for each component k
/// its own:
///
///   rho_f = rho_0 + sum_i (rho_i - rho_0) alpha_f,i
///   rhohat_c,k = rho_c + (1/V) sum_f lambda_cf (rho_f - rho_c) d_k S_k.
///
/// rho_c is the density of the cell by its fractions, and rhohat is `inertia`. With alpha_f of the
/// prism between two centres, cells and faces have the same total mass on quadrilaterals and
/// hexahedra.
class Density {
 public:
  /// rho_0: that of the fluid.
  Density(const Mesh& mesh, const FaceWeights& weights, Real rho_0);

  /// Sets the density of the fluid everywhere.
  void clear();
  /// Adds a solid of that density by its fractions of cells (owned and halo) and of the listed
  /// faces.
  void add(Real rho, const CellField<Real>& alpha, const FaceField<Real>& alpha_f,
           std::span<const Index> faces);
  /// Collective. Sets rhohat, owned and halo, from all that was added.
  void finish();

  /// Density of the fluid.
  Real rho_0() const { return rho_0_; }
  /// rho_f.
  const FaceField<Real>& of_face() const { return of_face_; }
  /// rho_c.
  const CellField<Real>& of_cell() const { return of_cell_; }
  /// rhohat.
  const CellField<Vec3>& inertia() const { return inertia_; }
  /// v / rhohat in cell c.
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

/// The flux that all forces make by the inertia of the face, less that by the inertia of the cells,
/// times rho_f:
///   Phi(F)_f - rho_f Phi(F / rhohat)_f,   Phi with the weights of `predict_flux`.
/// a: the acceleration F / rhohat that they give the cells, owned and halo. It holds the viscous
/// force too. In a viscous solid that balances the others, and a flux of the others alone is false
/// by rho / rho_s - 1 times all of them.
Real flux_of_force(const Density& density, const CellField<Vec3>& a, const FaceWeights& weights,
                   const Mesh& mesh, Index f);

}  // namespace fsi::flow
