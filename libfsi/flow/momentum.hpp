#pragma once
// The momentum equation up to the pressure correction.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/linear_system_vector.hpp"

namespace fsi::flow {

/// Face viscosity mu = alpha mu_s + (1 - alpha) mu_f [Matsumiya25] (3), alpha averaged linearly.
void mixture_viscosity(FaceField<Real>& mu, const CellField<Real>& alpha, Real mu_f, Real mu_s,
                       const FaceWeights& weights, const Mesh& mesh);

/// conv_c = sum_f phi_f u_f - u_c sum_f phi_f: div(phi u) integrated over owned cells, u_f linear
/// with skewness correction; exact for a uniform u whatever phi is.
void convection(CellField<Vec3>& conv, const FaceField<Real>& phi, const CellField<Vec3>& u,
                const BoundaryField<Vec3>& u_b, const CellField<Tensor>& L,
                const FaceWeights& weights, const Mesh& mesh);

/// visc_c += sum_f mu_f g_f (u_N - u_P): the compact part of div(mu grad u) over owned cells.
/// Faces of openings carry no viscous flux.
void viscous_compact(CellField<Vec3>& visc, const FaceField<Real>& mu, const CellField<Vec3>& u,
                     const BoundaryField<Vec3>& u_b, const std::vector<char>& open_face,
                     const FaceWeights& weights, const Mesh& mesh);

/// rest_c += sum_f mu_f k_f . (grad u)_f + (grad u)_c^T . sum_f (mu_f - mu_0) S_f: what the compact
/// part leaves of div(mu (grad u + grad u^T)). By div u = 0 the transpose is (grad u)^T . grad mu,
/// which acts only where mu changes; as a sum of fluxes mu (grad u)_f^T . S_f it would feed, all
/// over the more viscous phase, on what little divergence the cell velocities have, explicitly.
void viscous_rest(CellField<Vec3>& rest, const FaceField<Real>& mu, Real mu_0,
                  const CellField<Tensor>& L, const std::vector<char>& open_face,
                  const FaceWeights& weights, const Mesh& mesh);

/// (1 / 2V) sum_f |phi_f| of a cell: its Courant number per time.
Real courant_rate(const FaceField<Real>& phi, const Mesh& mesh, Index c);

/// Weights of what is known at t^n, at dt_old before and at dt_before before that, for its mean
/// over the dt after t^n [Hairer93] (III.5): by the line through the first two and the part `bend`
/// of what the parabola through all three adds to it; 1: exact for quadratic functions of t, 0: for
/// linear ones. By the line where dt_before is 0 or a step more than twice the one before it, so
/// far beyond which the parabola would exaggerate; by the first where dt_old is 0.
std::array<Real, 3> adams_bashforth(Real dt, Real dt_old, Real dt_before, Real bend);

/// What the predictor needs besides u and p.
struct Sources {
  const CellField<Vec3>& force;  ///< elastic force per volume
  Vec3 body;                     ///< uniform force per volume (mean-velocity forcing)
};

/// The predictor [Matsumiya25] (12), second order in time (Adams-Bashforth of third order for
/// convection, of second for the explicit viscous rest, theta = 1/2 for the compact viscous term),
/// in increments w = u* - u^n:
///   rho V w / dt - sum_f (theta mu + kappa) g (w_N - w_P)
///     = -rho AB3(conv) + visc(u^n) + AB2(rest) + V (-grad p^n + f + S).
/// What moves with a body through the mesh changes by Courant numbers in a step: there AB2 is off
/// by 5/12 Co^2 of a wave's second difference, more than half of what the linear face value is
/// (1/6) at Co = 0.5. Between Courant numbers of 0.66 and 0.9 AB3 gives way to AB2.
/// theta = 1 where mu_s / mu_f > 2 or in the first steps, which damps what an impulsive start
/// leaves. With `hold_past` visc acts on u^n - (theta - 1/2) (dt / dt_old) (u^n - u^(n-1)) after
/// these, which makes up for theta to second order: rho u_t = -l u, z the factor of a step,
///   (1 + theta l) z^2 - (1 + (2 theta - 3/2) l) z + (theta - 1/2) l = 0,  here l for l dt / rho:
/// with theta = 1 |z| falls to 2^(-1/2) as l grows, and an explicit rest of up to l is stable.
class Momentum {
 public:
  Momentum(const Mesh& mesh, const FaceWeights& weights, const std::vector<Condition>& conditions,
           Real rho, Real mu_0);

  /// u becomes u* (owned and halo). u_b holds the boundary velocity of t^n, u_b_new that of t^n+1.
  /// mu_varies: in time and space; stiff: kappa does; without, it is zero for good.
  /// Returns the iterations. Errors: Error{numerics}.
  int predict(CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
              const BoundaryField<Vec3>& u_b_new, const CellField<Vec3>& grad_p,
              const CellField<Tensor>& L, const FaceField<Real>& phi, const FaceField<Real>& mu,
              const FaceField<Real>& kappa, bool mu_varies, bool stiff, const Sources& sources,
              Real dt);

  /// Explicit terms of past steps, part of a checkpoint.
  struct History {
    CellField<Vec3> convection, convection_before;  ///< of the last step and the one before
    CellField<Vec3> rest;                           ///< of the last step
  };
  History& history() { return history_; }
  Real dt_old = 0, dt_before = 0;  ///< lengths of those steps, 0: none yet
  std::int64_t steps_taken = 0;
  Real theta = 0.5;  ///< after the first steps, at least
  /// The theta of a step of dt: more than `theta` where viscosity smooths a cell within the step
  /// and there is an explicit rest, on non-orthogonal meshes and after `expect`: it would make it
  /// unstable. From 1/2 where
  /// l = mu dt / rho max_c sum g / V is below 2 it rises to 1 as 1 - 1 / l.
  Real theta_at(Real dt) const;
  /// The theta of the last `predict`: 1 in the first steps, then theta_at; what goes with its u*.
  Real theta_taken() const { return assembled_[0]; }
  /// Collective. There is an explicit viscous rest on any mesh, of a viscosity up to mu_max: raises
  /// theta_at and extrapolates less of it. Before the first step.
  void expect(Real mu_max);
  /// The velocity before the last step, part of a checkpoint, and at the boundary, to be set from
  /// it before `predict`.
  struct Past {
    CellField<Vec3> u;
    BoundaryField<Vec3> u_b;
  };
  /// Second order in time from now on, whatever theta is; before the first step.
  void hold_past();
  /// Empty without hold_past.
  std::optional<Past>& past() { return past_; }
  /// Faces without viscous flux: those of openings.
  const std::vector<char>& open_face() const { return open_face_; }

 private:
  /// Collective. The part of AB3 in a step of dt.
  Real bend(const FaceField<Real>& phi, Real dt) const;
  void add_convection(const FaceField<Real>& phi, const CellField<Vec3>& u,
                      const BoundaryField<Vec3>& u_b, const CellField<Tensor>& L, Real dt);
  void add_rest(const FaceField<Real>& mu, const CellField<Tensor>& L, Real dt);
  void add_compact(const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                   const FaceField<Real>& mu, Real theta_now, Real dt);
  void assemble(const FaceField<Real>& mu, const FaceField<Real>& kappa, Real theta_now, Real dt);
  /// Share of the viscous rest that is extrapolated: the whole below l = 2, beyond 2 / l.
  Real extrapolated(Real dt) const;
  void set_rhs(const BoundaryField<Vec3>& u_b, const BoundaryField<Vec3>& u_b_new,
               const CellField<Vec3>& grad_p, const FaceField<Real>& mu,
               const FaceField<Real>& kappa, const Sources& sources, Real theta_now);
  const Mesh& mesh_;
  const FaceWeights& weights_;
  Real rho_, mu_0_;
  // mu / rho times the largest sum over a cell's faces of g / V; 0: no explicit viscous rest
  Real rate_ = 0;
  std::vector<char> open_face_;
  std::vector<Vec3>
      implicit_;  // [n_boundary] share of the viscous flux in each component's diagonal
  History history_;
  bool has_rest_ = false;  // there is a viscous rest
  CellField<Vec3> rhs_;
  std::optional<Past> past_;
  std::vector<Real> w_, b_;  // dim values a cell: [n_cells], [n_owned]
  VectorSystem system_;
  std::array<Real, 2> assembled_{0, 0};  // theta and dt of the matrix in place
};

}  // namespace fsi::flow
