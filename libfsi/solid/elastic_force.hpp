#pragma once
// Elastic stress of a solid and the force it puts into the momentum equation.

#include "libfsi/field/band.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/balanced_jump_force.hpp"
#include "libfsi/solid/flow_snapshot.hpp"

namespace fsi::solid {

/// What the stress is made of.
struct ElasticState {
  const CellField<SymTensor>& T;     ///< what the law makes of B (law/law.hpp), neo-Hookean: B; on
                                     ///< the band's cells, zero elsewhere; owned and halo
  const CellField<Real>& alpha;      ///< owned and halo
  const FaceField<Real>* alpha_f{};  ///< part of solid at the band's faces; T is then known around
                                     ///< the solid as well. None: from alpha T of the cells
  const FaceField<Vec3>* normal{};   ///< of the interface there, zero without one; with alpha_f
  const SymmetryFaces* mirror{};     ///< planes of symmetry, which bear no shear
  const std::vector<char>* open{};   ///< [n_boundary] 1 on openings, which bear no elastic stress
};

/// Force of the elastic stress, and its counterpart in the balanced face flux.
class ElasticForce {
 public:
  /// mesh and weights must outlive it.
  ElasticForce(const Mesh& mesh, const FaceWeights& weights, Real G);

  /// Collective. tau = G dev(alpha T)                                     [Matsumiya25] (11)
  /// force_c = (1/V) sum_f tau_f . S_f, tau_f from alpha T linear between cells, as in the paper.
  /// With alpha_f, tau_f = G dev T_f is that of T linear between cells. With m the normal and
  /// s = m . tau_f . m,
  ///   force_c = (1/V) sum_f (alpha_f (tau_f - s I) + alpha_c s I) . S_f
  ///             + sum_f g_cf s (alpha_n - alpha_c).
  /// The part that a jump of the pressure bears is differenced as the pressure is, by the weights
  /// g_cf of the stencil. The other is differenced as the viscous flux. Skewness correction
  /// throughout. At boundaries alpha T (with alpha_f: T) continues linearly. At openings there is
  /// none, so that what has left neither pulls nor pushes; a stress continued there would work on
  /// what is still inside. Beyond a plane of symmetry the image of a triangle or tetrahedron is one
  /// of its neighbours (`set_slopes_at_planes`).
  /// rhie_chow_source_f is (s_N - s_P) - (grad s)_f . d of s = n . tau . n along d; with alpha_f
  /// that of the cells' alpha times T, and that of the jump of the pressure. It vanishes for a
  /// linear stress. Both are added to what is there. force: owned and halo after. grad: scratch
  /// that nothing but the solid writes to, zero at first.
  void apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, const ElasticState& solid,
             const FaceWeights& weights, PressureStencil& pressure, const Band& band,
             CellField<SymGradient>& grad);

  /// Shear modulus.
  Real G() const { return G_; }

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
  BalancedJumpForce jump_force_;   // the jump of the normal stress
  std::vector<Index> last_cells_;  // where grad was written
};

}  // namespace fsi::solid
