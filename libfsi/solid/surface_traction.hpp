#pragma once
// The viscous stress at the solid's surface, where its viscosity is another than the fluid's.

#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/solid/balanced_jump_force.hpp"

namespace fsi::solid {

/// What the traction is made of; cell fields owned and halo.
struct Surface {
  const CellField<Vec3>& u;         ///< velocity
  const CellField<Tensor>& L;       ///< velocity gradient
  const std::vector<Tensor>& L_f;   ///< at irregular faces, as the momentum equation has it
  const CellField<SymTensor>& T;    ///< as the elastic force takes it; known around the surface
  const CellField<Real>& alpha;     ///< fraction of the solid
  const FaceField<Real>& alpha_f;   ///< part of solid on the way between the centres
  const FaceField<Vec3>& normal_f;  ///< of the surface there, zero away from it
  const CellField<Vec3>& normal;    ///< out of the solid; zero away from the surface
  const CellField<Real>& height;    ///< of the cell's centre above the surface
  const FaceField<Real>& mu;        ///< what the momentum equation has, the mean of the cells'
};

/// The two viscosities.
struct Viscosities {
  /// Dynamic viscosity of each.
  Real solid, fluid;
};

/// Replaces what the momentum equation has at faces at the surface, normal m. In its place comes a
/// viscous stress that is exact for a linear velocity with a kink a m, a . m = 0, at a plane
/// surface. The traction along the surface is one, of viscosities in series:
///
///   T = mu_s (2 D_s . m)_t + G (T . m)_t = mu_f (2 D_f . m)_t,   t: along the surface
///   T = mu_h ((2 D . m)_t + alpha_f G (T . m)_t / mu_s),   1 / mu_h = alpha_f / mu_s
///       + (1 - alpha_f) / mu_f,   2 D . m = alpha_f 2 D_s . m + (1 - alpha_f) 2 D_f . m
///
/// and so is D without its part (D . m)_t, D^0. With s = (mu_s - mu_f) 2 m . D . m the excess over
/// mu_f 2 D and over what the elastic stress has is
///
///   (mu_h - mu_f) (e m + m e) + (alpha_f mu_h / mu_s - alpha_f) G (b m + m b)
///     + alpha_f ((mu_s - mu_f) 2 D^0 - s I) + alpha_c s I,   e = (2 D . m)_t, b = (T . m)_t
///
/// and sum_f g_cf s (alpha_n - alpha_c): a jump of the pressure bears s (elastic_force.hpp). D is
/// that of the cells' least-squares fit of L . r + a (min(0, h + m . r) - min(0, h)); but in e . m
/// the difference along d is that of the face. mu_s counts as mu_f / 4 at least, less the
/// difference times D of the solid's own side: nothing would tie the fluid to a solid without
/// viscosity.
///
/// Over the lesser viscosity, the transposed gradient of uncut cells of the more viscous side
/// becomes a sum of fluxes too, |mu_s - mu_f| L_f^T . S with L of that side. So no flux is lost:
/// what one cell loses another gets. That of the other side is none.
class SurfaceTraction {
 public:
  /// Collective.
  SurfaceTraction(const Mesh& mesh, const FaceWeights& weights, Real G, Viscosities mu);

  /// Collective. Adds to the force, and the jump of s to the face flux's balance. band: that of the
  /// elastic stress, force and balance cleared there.
  void apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, const Surface& surface,
             const FaceWeights& weights, PressureStencil& pressure, const Band& band);

  /// Viscosities of more than this many times the fluid's are left to the mean of the cells: a
  /// stress of that size, taken explicitly, makes the strain rough.
  static constexpr Real ratio_max = 50;

  /// After apply: what makes the explicit stress stable at the faces of cells at the surface where
  /// the fluid is the more viscous; nothing where the solid is, whose own implicit term does it.
  ///
  ///   kappa_f <- kappa_f mu_h / mu_s + c (mu_f - mu_s),   c = 1
  ///
  /// kappa_f has alpha_f, the elastic stress alpha_f mu_h / mu_s. The second is on the change of u
  /// in a step, an error of dt in the stress of these faces alone: of second order in u if dt ~ h.
  /// With c = 0.2 an inclusion of mu_s / mu_f = 1e-4 in Stokes flow grows, with 0.3 it does not.
  void add_semi_implicit(FaceField<Real>& kappa, const FaceField<Real>& alpha_f,
                         const Band& band) const;

  /// mu_s / mu_f of the two in series.
  Real in_series() const { return mu_least_ / mu_.fluid; }

 private:
  void clear(const Band& band);
  /// Of a cell of the more viscous side.
  bool uncut(Real alpha) const;
  void mark(const Surface& surface, const Band& band);
  void fit(const Surface& surface, Index c);
  void take_own_strain(const Surface& surface, const Band& band);
  void add_excess(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, const Surface& surface,
                  const FaceWeights& weights, PressureStencil& pressure, const Band& band);
  void add_transposed(CellField<Vec3>& force, const Surface& surface, const FaceWeights& weights,
                      const Band& band) const;
  /// The excess times S at a face but for alpha_c s I, over the lesser viscosity; and s.
  struct FaceExcess {
    Vec3 flux;
    Real s;
  };
  FaceExcess excess_at(Index f, const Surface& surface, const FaceWeights& weights) const;
  /// Gradient along the surface, kink and the solid's own D at a face.
  struct Sides {
    Tensor L;
    Vec3 a;
    SymTensor own;
  };
  Sides sides(Index f, const Vec3& m, const FaceWeights& weights) const;

  const Mesh& mesh_;
  Real G_;
  Viscosities mu_;
  Real mu_least_;                 // that counts for the solid's in series
  BalancedJumpForce jump_force_;  // s
  CellField<Real> touch_;         // 1: has a face at the surface; 2: and is uncut, more viscous
  CellField<Tensor> L_, L_in_;  // fit at the surface; of the more viscous side's uncut cells there
  CellField<Real> fitted_;      // 1: has a fit
  CellField<Vec3> kink_;        // a
  CellField<SymTensor> own_;    // 2 D of the solid's side
  CellField<Real> has_own_;     // 1: of its own cells, 2: continued
  std::vector<Index> last_cells_, last_faces_;
};

}  // namespace fsi::solid
