#pragma once
// The momentum equation up to the pressure correction.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/flow/convection.hpp"
#include "libfsi/flow/viscous.hpp"
#include "libfsi/flow/wall_parabola.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/linear_system_vector.hpp"

namespace fsi::flow {

/// The time after a step of dt_old over which its change is extrapolated in the next, of dt: no
/// more than twice dt_old. After a jump the step before may be a thousandth of the next.
Real reach(Real dt, Real dt_old);

/// Weights of what is known at t^n, at dt_old before and at dt_before before that, for its mean
/// over the dt after t^n [Hairer93] (III.5). They are those of the line through the first two and
/// of the part `ab3_weight` of what the parabola through all three adds to it. With a part of 1
/// they are exact for quadratic functions of t, with 0 for linear ones. By the line alone where
/// dt_before is 0 or a step more than twice the one before it, so far beyond which the parabola
/// would exaggerate. The line rises over `reach` of dt alone. By the first where dt_old is 0.
std::array<Real, 3> adams_bashforth(Real dt, Real dt_old, Real dt_before, Real ab3_weight);

/// What the predictor needs besides u.
struct MomentumTerms {
  const BoundaryField<Vec3>& u_b;      ///< at t^n
  const BoundaryField<Vec3>& u_b_new;  ///< at t^n+1
  const CellField<Vec3>& grad_p;       ///< at t^(n-1/2)
  const CellField<Tensor>& L;          ///< read where the viscosity varies or convection is upwind
  const std::vector<Tensor>& L_f;      ///< at irregular faces
  const FaceField<Real>& phi;          ///< volume flux at t^n
  const FaceField<Real>& mu;           ///< viscosity at the faces
  const FaceField<Real>& kappa;        ///< what is implicit besides the viscosity
  bool mu_varies = false;              ///< in time and space
  bool stiff = false;                  ///< kappa does; else it is zero for good
  const CellField<Vec3>& force;        ///< elastic force per volume
  /// Density of the cells for each component, owned and halo; none: that of the fluid everywhere.
  const CellField<Vec3>* rho = nullptr;
  /// Where there is such a density: set to the acceleration by all forces, (u* - u^n)/dt less that
  /// by convection; owned and halo.
  CellField<Vec3>* acceleration = nullptr;
  Vec3 body{};  ///< uniform force per volume (mean-velocity forcing)
  /// Courant number beyond which kappa takes the convection of triangles and tetrahedra (Courant).
  Real explicit_courant = std::numeric_limits<Real>::max();
  /// Irregular faces with a one-sided L_f beside a surface. If there may be such faces, `stiff`.
  std::span<const Index> one_sided{};
  /// Kinks of u at the surfaces of solids, read by linear convection; null: none.
  const Kinks* kinks = nullptr;
  const WallParabola* parabola = nullptr;  ///< of the walls; none: their derivative by differences
};

/// The predictor [Matsumiya25] (12), of second order in time, in increments w = u* - u^n.
/// Convection is by Adams-Bashforth of third order, the explicit viscous part E by that of second.
/// With C the compact viscous term,
///   rho V w / dt - sum_f (theta_f mu + kappa) g (w_N - w_P)
///     = -rho AB3(conv) + C(u^n) - C((theta_f - 1/2) (reach / dt_old) (u^n - u^(n-1)))
///       + AB2(E) + V (-grad p^(n-1/2) + f + S),
/// with `reach` of dt, at most 2 dt_old.
/// What moves with a body through the mesh changes by Courant numbers in a step. There AB2 is off
/// by 5/12 Co^2 of a wave's second difference. At Co = 0.5 that is more than half of the 1/6 by
/// which the linear face value is off. Between Courant numbers of 0.66 and 0.9 the scheme blends
/// from AB3 to AB2.
///
/// theta_f = (1 + |k| / |S_f|) / 2, at most 1. Let rho u_t = -l (1 + r) u with r l u explicit. The
/// factor z of a step, with l for l dt / rho,
///   (1 + theta l) z^2 - (1 + (2 theta - 3/2) l - 3/2 r l) z + (theta - 1/2 - r / 2) l = 0
/// stays in the unit circle for any l if r < 2 theta - 1. The term in u^(n-1) keeps the scheme of
/// second order. At a face in `one_sided`, E may be larger than |k| / |S_f| times the compact term.
/// There theta_f is larger by max(0, 1/4 - 1/l_f), l_f = dt mu g (1/V_P + 1/V_N) / rho. theta_f is
/// 1 at all faces where mu_s / mu_f is above 2 or below 1/2. It is 1 in the first steps, too,
/// without the term in u^(n-1): this damps an impulsive start.
class Momentum {
 public:
  /// Collective. rho, mu_0: of the fluid; mesh, weights and conditions must outlive it.
  Momentum(const Mesh& mesh, const FaceWeights& weights, const std::vector<Condition>& conditions,
           Real rho, Real mu_0, Convection scheme = Convection::linear);

  /// u becomes u* (owned and halo). Returns the iterations. Errors: Error{numerics}.
  int predict(CellField<Vec3>& u, const MomentumTerms& terms, Real dt);

  /// Explicit terms of past steps, part of a checkpoint.
  struct History {
    CellField<Vec3> convection, convection_before;  ///< of the last step and the one before
    CellField<Vec3> rest;                           ///< of the last step
  };
  /// The same, to list and to restore.
  History& history() { return history_; }
  Real dt_old = 0, dt_before = 0;  ///< lengths of those steps, 0: none yet
  std::int64_t steps_taken = 0;    ///< since t = 0, or since hold_old made its fields
  Real theta = 0.5;                ///< after the first steps, at least
  /// The least theta of a step of dt after the first ones: more than `theta` after
  /// `bound_explicit_viscosity` where viscosity smooths a cell within the step, as the transposed
  /// term would make it unstable. From 1/2 where l = mu dt / rho max_c sum g / V is below 2 it
  /// rises to theta_max as theta_max - (2 theta_max - 1) / l.
  Real theta_at(Real dt) const;
  /// theta_f of the last `predict`, what goes with its u*.
  const FaceField<Real>& theta_taken() const { return theta_f_; }
  /// The largest Courant number of the last `predict`, of the fluxes that it began with.
  Real courant() const { return courant_; }
  /// Collective. There is an explicit viscous term of a viscosity up to mu_max: raises theta_at and
  /// extrapolates less of the rest. The transposed term needs a theta_max of 1, the parabola of the
  /// walls 3/4. Between two steps; the largest of several holds.
  void bound_explicit_viscosity(Real mu_max, Real theta_max = 1);
  /// The velocity before the last step, part of a checkpoint, and at the boundary, to be set from
  /// it before `predict`.
  struct Old {
    CellField<Vec3> u;        ///< in the cells
    BoundaryField<Vec3> u_b;  ///< at the boundary
  };
  /// Second order in time from now on where theta = 1 at all faces. Between two steps; the next two
  /// are damped as the first ones are.
  void hold_old();
  /// Second order in time where theta is between 1/2 and 1, from the first step on.
  void hold_old_of_part();
  /// Empty on regular meshes without one of these.
  std::optional<Old>& old() { return old_; }
  /// What the viscous term makes of the conditions.
  const ViscousBoundary& boundary() const { return boundary_; }
  /// The convection's scheme.
  Convection scheme() const { return scheme_; }
  /// Whether L is read at all.
  bool reads_L() const {
    return scheme_ == Convection::linear_upwind || scheme_ == Convection::limited;
  }

 private:
  /// Collective. The part of AB3 in a step of dt.
  Real ab3_weight(const MomentumTerms& terms, Real dt);
  void set_theta(Real theta_now);
  /// The least of an irregular face.
  Real theta_of(Index f, Real theta_now) const;
  /// Whether f lies on a plane of symmetry.
  bool mirrored(Index f) const;
  /// g of face f; on a plane of symmetry that between the cell and its image, half as large.
  Real between_cells(Index f) const;
  /// Takes back what it raised the last time.
  void raise_theta(const MomentumTerms& terms, Real theta_now, Real dt);
  void add_convection(const CellField<Vec3>& u, const MomentumTerms& terms, Real dt);
  void add_rest(const CellField<Vec3>& u, const MomentumTerms& terms, Real dt);
  void add_compact(const CellField<Vec3>& u, const MomentumTerms& terms, Real dt);
  void add_sources(const MomentumTerms& terms);
  /// Sets in a what the acceleration by forces is more than the change of u: that of convection.
  void set_convective(CellField<Vec3>& a, const CellField<Vec3>& rho) const;
  /// Collective. Adds the change of u per time.
  void add_change(CellField<Vec3>& a, Real dt) const;
  /// The matrix of rho V / dt w - sum_f a_f g (w_N - w_P), a = theta mu + kappa.
  void assemble(const MomentumTerms& terms, Real dt);
  /// Share of the viscous rest that is extrapolated: the whole below l = 2, beyond 2 / l.
  Real extrapolated(Real dt) const;

  const Mesh& mesh_;
  const FaceWeights& weights_;
  Real rho_, mu_0_;
  Convection scheme_;
  // mu / rho times the largest sum over a cell's faces of g / V; 0: no explicit viscous term needs
  // a larger theta
  Real rate_ = 0;
  Real theta_max_ = 0.5;  // the largest theta that such a term needs
  ViscousBoundary boundary_;
  // [n_boundary] share of the viscous flux in each component's diagonal
  std::vector<Vec3> implicit_;
  std::vector<char> slips_;     // [n_boundary] 1 on planes of symmetry
  std::vector<Index> coupled_;  // slip faces of oblique normals, in the order of the couplings
  History history_;
  FaceField<Real> theta_f_;
  std::vector<Index> raised_;  // where theta_f_ is raised for one-sided gradients
  CellField<Vec3> rhs_;
  Real courant_ = 0;
  std::optional<Old> old_;
  bool whole_past_ = false;  // also where theta is 1 at all faces
  std::vector<Real> w_, b_;  // dim values a cell: [n_cells], [n_owned]
  VectorSystem system_;
  std::array<Real, 2> assembled_{0, 0};  // theta and dt of the matrix in place
};

}  // namespace fsi::flow
