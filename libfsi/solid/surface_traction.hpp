#pragma once
// The viscous stress at a surface between two viscosities, that of the solid and that of the fluid.

#include <cmath>
#include <vector>

#include "libfsi/field/band.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/balanced_jump_force.hpp"
#include "libfsi/solid/flow_snapshot.hpp"

namespace fsi::solid {

/// The fields from which the traction follows; cell fields owned and halo.
struct Surface {
  const CellField<Vec3>& u;         ///< velocity
  const CellField<Tensor>& L;       ///< velocity gradient
  const std::vector<Tensor>& L_f;   ///< at irregular faces, as in the momentum equation
  const CellField<SymTensor>& T;    ///< as in the elastic force; set around the surface
  const CellField<Real>& alpha;     ///< fraction of the solid
  const FaceField<Real>& alpha_f;   ///< part of solid between the centres
  const FaceField<Vec3>& normal_f;  ///< m at the faces, zero away from the surface
  const CellField<Vec3>& normal;  ///< m in the cells, out of the solid; zero away from the surface
  const CellField<Real>& height;  ///< distance l of the cell's centre from the surface
  const FaceField<Real>& mu;      ///< viscosity, as in the momentum equation
};

/// The two viscosities.
struct Viscosities {
  /// Dynamic viscosities mu_s and mu_f.
  Real solid, fluid;
};

/// Replaces the viscous stress of the momentum equation at faces at the surface. The new stress is
/// exact for a linear velocity with a kink a m, a . m = 0, at a plane surface with normal m. The
/// two viscosities act in series along the surface, with the harmonic mean mu_h:
///
///   gammadot = (2 D . m)_t,   tau_t = G (T . m)_t,   t: the part along the surface,
///   1 / mu_h = alpha_f / mu_s + (1 - alpha_f) / mu_f,   s_mu = (mu_s - mu_f) 2 m . D . m.
///
/// The traction along the surface is the same on both sides,
///   mu_s gammadot_solid + tau_t = mu_f gammadot_fluid = mu_h (gammadot + alpha_f tau_t / mu_s),
/// with gammadot = alpha_f gammadot_solid + (1 - alpha_f) gammadot_fluid. In cell c the stress of
/// the face beyond mu_f 2 D and beyond the elastic stress of ElasticForce is
///
///   (mu_h - mu_f) (gammadot m + m gammadot) + alpha_f (mu_h / mu_s - 1) (tau_t m + m tau_t)
///     + alpha_f ((mu_s - mu_f) 2 D^0 - s_mu I) + alpha_c s_mu I,
///
/// D^0 = D - (gammadot m + m gammadot) / 2, the same on both sides. A jump of the pressure balances
/// the rise s_mu (alpha_N - alpha_P), which acts by calL_c and c_f (BalancedJumpForce).
///
/// D comes from a least-squares fit of L . r + a (min(0, l + m . r) - min(0, l)), l the distance
/// from the surface (`height`). If the solid is the more viscous one, D^0, s_mu and the gradient
/// along the surface come from its own cells alone, and so does its part of gammadot. Its strain is
/// small, and an error of it counts by mu_s. In gammadot . m the difference along d is that of the
/// face.
///
/// mu_s counts as at least mu_f / 4, and the surplus times D of the solid's own side is subtracted.
/// Nothing else would tie the fluid to a solid without viscosity. In D^0, s_mu and m gammadot it
/// counts as at most `explicit_ratio_max` mu_f.
///
/// In uncut cells of the more viscous side the transposed gradient becomes a sum of fluxes too,
/// |mu_s - mu_f| L_f^T . S with L of that side. On the other side it has no such fluxes. The flux
/// of a face is the same for both of its cells.
///
/// A face that another solid with a viscosity of its own shares keeps the mean viscosity and the
/// elastic stress as they are: each of the two would subtract the part of both.
class SurfaceTraction {
 public:
  /// Collective. symmetry: planes beyond which the images of cells count as neighbours. mesh and
  /// weights must outlive it.
  SurfaceTraction(const Mesh& mesh, const FaceWeights& weights, Real G, Viscosities mu,
                  SymmetryFaces symmetry = {});

  /// Collective. Adds to the force, and adds the rises of s_mu to c_f (`rhie_chow_source`). band:
  /// that of the elastic stress, force and c_f cleared there.
  void apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, const Surface& surface,
             PressureStencil& pressure, const Band& band);

  /// Implicit part C_s of mu_s - mu_f at the faces of triangles and tetrahedra at the surface, if
  /// the solid is the more viscous one. Between cells with little solid the mean viscosity is
  /// small, and the explicit stress is not. With C_s = 0 a disc of mu_s / mu_f = 16 in Stokes flow
  /// becomes unstable there. On other cells one of 200 does not.
  static constexpr Real implicit_share = 0.25;

  /// After apply: makes the explicit stress stable at the faces of cells at the surface, if the
  /// fluid is the more viscous one, by the first line. If the solid is, by the second one
  /// on triangles and tetrahedra alone.
  ///
  ///   stiff_f <- stiff_f + kappa_f (mu_h / mu_s - 1) + C (mu_f - mu_s),   C = 1
  ///   stiff_f <- stiff_f + min(C_s (mu_s - mu_f), `explicit_ratio_max` mu_f)
  ///
  /// stiff: that of all solids, kappa before the first of them is added.
  /// The explicit stress counts mu_s as at most `explicit_ratio_max` mu_f, so that the second line
  /// needs no more. More of it acts as inertia: it holds up the decay of a flow beside the surface.
  /// The strain of the solid then feeds on that flow in a disc of mu_s / mu_f = 200 at rest.
  /// The elastic stress of such a face has the factor alpha_f mu_h / mu_s, where kappa_f has
  /// alpha_f. The second term acts on the change of u in a step. Its error is of order dt in the
  /// stress of these faces alone, and of second order in u if dt ~ h. With C = 0.2 an inclusion of
  /// mu_s / mu_f = 1e-4 in Stokes flow becomes unstable, with 0.3 it does not.
  void add_semi_implicit(FaceField<Real>& stiff, const FaceField<Real>& kappa,
                         const FaceField<Real>& alpha_f, const Band& band) const;

  /// Before apply and the momentum equation: lowers mu of the faces at the surface to
  ///
  ///   mu <- min(mu, mu_h + `explicit_ratio_max` mu_f).
  ///
  /// The explicit stress is the difference to the exact one, mu_h and at most `explicit_ratio_max`
  /// mu_f of the cells' gradients. An implicit mu far above both slows each change of u down, and
  /// the explicit difference, extrapolated, makes energy in Stokes flow with mu_s / mu_f of 150.
  void bound_viscosity(FaceField<Real>& mu, const CutFaces& cut, const Band& band) const;

  /// The velocity gradient of a more viscous solid in cell c by the last `apply`: in cells at the
  /// surface, from the solid alone. Null in other cells.
  const Tensor* own_gradient(Index c) const {
    return mu_.solid > mu_.fluid && has_own_[c] > 0 ? &L_viscous_[c] : nullptr;
  }

  /// Largest Courant number Co beside the solid, mu_s / mu_f Co^2 <= 2.5. The explicit stress is
  /// that before the step. Where the solid passes the mesh, the change in the step pushes it across
  /// the stream, in proportion to mu_s / mu_f Co^2. With 2.5 this is as much as with a ratio of 10
  /// in the usual steps of Co = 0.5.
  Real courant_max() const { return std::sqrt(2.5 * mu_.fluid / mu_.solid); }

  /// mu_s / mu_f of the two in series.
  Real in_series() const { return mu_least_ / mu_.fluid; }

 private:
  /// Largest mu_s / mu_f in D^0, s_mu and m gammadot. A larger explicit stress of the gradients in
  /// cells makes energy in slow flows. A layer of a cell that resists with 20 mu_f strains by a
  /// twentieth of what the fluid does, so that the body is nearly as rigid. gammadot m, which has
  /// the difference along d, and the inner faces have the whole of mu_s.
  static constexpr Real explicit_ratio_max = 20;

  void clear(const Band& band);
  /// Whether a cell of face f is a triangle or a tetrahedron.
  bool simplex(Index f) const;
  /// Half the sum of the owner's value and its image beyond the plane of symmetry at face f.
  template <class T>
  T with_image(const T& of_owner, Index f) const;
  /// The mean of both cells at the centre of f, with the image at a plane of symmetry.
  template <class T>
  T at_face(const CellField<T>& field, Index f) const;
  /// The mean of the fitted cells at f, with the image at a plane of symmetry.
  template <class T>
  T of_fits(const CellField<T>& field, Index f) const;
  /// The difference of u along the vector d, and k = S - g d. At a plane of symmetry d leads half
  /// the way to the image, and S = g d.
  struct Pair {
    Vec3 du, d, k;
  };
  Pair pair(Index f, const CellField<Vec3>& u) const;
  /// Whether the surface lies between the centres of face f, beyond rounding of alpha, and the
  /// viscosity of f is that of this solid and the fluid alone.
  bool at_surface(const Surface& surface, Index f) const;
  /// Whether the surface lies between the centres of face f, beyond rounding of alpha.
  bool separates(const CutFaces& cut, Index f) const;
  /// Whether mu is that of this solid and the fluid alone, `own`, but for rounding.
  bool is_own(Real mu, Real own) const;
  /// mu of face f as flow::mixture_viscosity sets it, and as `bound_viscosity` leaves it.
  Real mean(const CutFaces& cut, Index f) const;
  Real bounded(const CutFaces& cut, Index f) const;
  /// mu_h with mu in place of mu_s.
  Real harmonic(Real alpha_f, Real mu) const;
  /// Whether a cell is uncut and on the more viscous side.
  bool uncut(Real alpha) const;
  void mark(const Surface& surface, const Band& band);
  void fit(const Surface& surface, Index c);
  void take_own_strain(const Surface& surface, const Band& band);
  /// Continues `own` from touched cells with has_own_ to those without, by means over neighbours
  /// in two rings; its halo.
  template <class T>
  void extend(CellField<T>& own, const Band& band);
  void add_excess(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, const Surface& surface,
                  PressureStencil& pressure, const Band& band);
  void add_transposed(CellField<Vec3>& force, const Surface& surface, const Band& band) const;
  /// The stress above times S at a face, without alpha_c s_mu I and over the lesser viscosity;
  /// s_mu.
  struct FaceExcess {
    Vec3 flux;
    Real s;
  };
  FaceExcess excess_at(Index f, const Surface& surface) const;
  /// At a face: the mean gradient over the line between the centres, the gradient from which
  /// follows what both sides have in common, and (mu_least - mu_s) 2 D of the solid's own side.
  struct Sides {
    Tensor mean, common;
    SymTensor lent;
  };
  Sides sides(Index f, const Vec3& m, Real alpha_f) const;

  const Mesh& mesh_;
  const FaceWeights& weights_;
  Real G_;
  Viscosities mu_;
  SymmetryFaces symmetry_;
  Real mu_least_;                 // mu_s as it counts in mu_h
  BalancedJumpForce jump_force_;  // of the rises of s_mu
  CellField<Real> touch_;         // 1: has a face at the surface; 2: and is uncut, more viscous
  CellField<Tensor> L_;           // fit at the surface, on the fluid's side
  CellField<Tensor> L_viscous_;   // of the more viscous side, at the surface
  CellField<Real> fitted_;        // 1: has a fit
  CellField<Vec3> kink_;          // a
  CellField<SymTensor> own_;      // 2 D of a less viscous solid
  CellField<Real> has_own_;       // what the solid alone tells: 1 by a fit, 2 and 3 by neighbours
  std::vector<Index> last_cells_, last_faces_;
};

}  // namespace fsi::solid
