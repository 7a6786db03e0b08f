#pragma once
// Elastic stress of a solid, and its force in the momentum equation.

#include "libfsi/field/band.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/balanced_jump_force.hpp"
#include "libfsi/solid/flow_snapshot.hpp"

namespace fsi::solid {

/// The fields from which the stress follows.
struct ElasticState {
  const CellField<SymTensor>& T;  ///< what the law makes of B (law/law.hpp), neo-Hookean: B; on
                                  ///< the band's cells, zero elsewhere; owned and halo
  const CellField<Real>& alpha;   ///< owned and halo
  /// Part of solid at the band's faces; T is then set around the solid as well. Null: the stress is
  /// that of alpha T, linear between the cells.
  const FaceField<Real>* alpha_f{};
  const FaceField<Vec3>* normal{};  ///< m of the interface there, zero without one; with alpha_f
  const SymmetryFaces* mirror{};    ///< planes of symmetry, which have no shear stress
  const std::vector<char>* open{};  ///< [n_boundary] 1 on openings, which have no elastic stress
  const std::vector<char>* film{};  ///< [n_boundary] 1 on walls with a film: no shear stress
};

/// Force of the elastic stress, and its counterpart c_f in the face flux.
class ElasticForce {
 public:
  /// mesh and weights must outlive it.
  ElasticForce(const Mesh& mesh, const FaceWeights& weights, Real G);

  /// Collective. tau = G dev(alpha T)                                     [Matsumiya25] (11)
  /// Without alpha_f the force is that of the paper, with alpha T linear between the cells:
  ///   force_c = (1/V) sum_f tau_f . S_f.
  /// With alpha_f, tau_f = G dev(T_f) and T is linear between the cells. Let m be the normal of the
  /// interface, s = m . tau_f . m and [p]_f = s (alpha_N - alpha_P):
  ///   force_c = (1/V) sum_f (alpha_f (tau_f - s I) + alpha_c s I) . S_f + calL_c.
  /// A jump of the pressure balances the normal part s. That part is therefore differenced as the
  /// pressure is (calL_c, BalancedJumpForce), and the rest as the viscous flux. Both are corrected
  /// for skewness.
  ///
  /// At boundaries T continues linearly from inside, or alpha T without alpha_f. An opening has no
  /// elastic stress: a stress continued there would work on the solid that is still inside. A wall
  /// with a film and a plane of symmetry bear its normal part only. At a plane of symmetry the
  /// image of a cell counts as its neighbour.
  ///
  /// The counterpart c_f is (s_N - s_P) - (grad s)_f . d of s = nu . tau . nu, nu = d / |d|. With
  /// alpha_f it is that of the cells' alpha times T, and that of the jump of the pressure
  /// (doc/theory/stress.md). It is zero for a linear stress. Both are added to `force` and
  /// `rhie_chow_source`. force: owned and halo after. grad: scratch that only the solid writes to,
  /// zero at first.
  void apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, const ElasticState& solid,
             const FaceWeights& weights, PressureStencil& pressure, const Band& band,
             CellField<SymGradient>& grad);

 private:
  void add_cell_averaged(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                         const ElasticState& solid, const FaceWeights& weights, const Band& band,
                         const CellField<SymGradient>& grad) const;
  void add_cut_face(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                    const ElasticState& solid, const FaceWeights& weights,
                    PressureStencil& pressure, const Band& band,
                    const CellField<SymGradient>& grad);

  const Mesh& mesh_;
  Real G_;
  BalancedJumpForce jump_force_;   // of the rises [p]_f
  std::vector<Index> last_cells_;  // where grad was written
};

}  // namespace fsi::solid
