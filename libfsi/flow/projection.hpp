#pragma once
// Face fluxes and the pressure correction.

#include <optional>
#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/flow/density.hpp"
#include "libfsi/flow/orthogonal.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/linear_system.hpp"
#include "libfsi/operators/vertex_mean.hpp"

namespace fsi::flow {

/// The terms of the face flux in addition to u*.
struct FluxTerms {
  /// Of u*, at irregular faces; of u^n between cells of InterfaceGradient.
  const std::vector<Tensor>& L_f;
  const CellField<Real>& p;           ///< pressure at the cells
  const CellField<Vec3>& grad_p;      ///< its averaged gradient
  const std::vector<Vec3>& grad_p_f;  ///< of p at irregular faces
  const BoundaryField<Real>& p_b;     ///< read on openings only
  /// c_f, counterpart of elastic stress and body force; 0 outside the solid.
  const FaceField<Real>& rhie_chow_source;
  const FaceField<Real>& mu;     ///< viscosity at the faces
  const FaceField<Real>& theta;  ///< implicit share of the viscous term
  const FaceField<Real>& kappa;  ///< implicit in addition to theta mu; 0 away from the solid
  /// Density of the fluid; length of the step.
  Real rho = 1, dt = 0;
  Real dt_old = 0;                                ///< length of the last step; 0: there was none
  const Density* density = nullptr;               ///< null: rho everywhere
  const CellField<Vec3>* acceleration = nullptr;  ///< of cells by all forces; read with a density
  Real stress = 0;                                ///< scale of the elastic stress; 0 without one
  const FaceField<Real>* stiffness = nullptr;     ///< dt G alpha_f lambda_B; null: no solid
  const FaceField<Real>* excess = nullptr;        ///< e_f of u^n; null: nothing is held
  Real t = 0;  ///< since the start of the flow; read with e_f only
};

/// e_f = phi_f - Phi(u)_f of one time: what the flux has in addition to the mean velocity. Inner
/// faces only; those of openings have their own (openings.hpp). u: owned and halo, L_f: of u.
void set_flux_excess(FaceField<Real>& excess, const FaceField<Real>& phi, const CellField<Vec3>& u,
                     const std::vector<Tensor>& L_f, const FaceWeights& weights, const Mesh& mesh);

/// Balanced, damped Rhie-Chow flux [Rhie83]:
///   phi* = Phi(u*) + w_f e_f + d_f { Phi(grad p) - g (p_N - p_P) - k . (grad p)_f + g c_f },
///   Phi(v) = [lambda v_P + (1 - lambda) v_N (+ L_f . delta_1-lambda for u*)] . S,
///   d_f = t_f / (rho + 4 t_f (theta_f mu + kappa + 2 dt G alpha_f lambda_B) / |d|^2),
///   w_f = (1 - a_f) max(0, 1 - rho d_f / T_f) + a_f max(0, 1 - t_f / t_f,old),
///   1 / T_f = 6 |u_f| / |d| + 3 mu / (rho |d|^2) + 1 / t.
/// The part w_f of the old excess stays. In a steady flow the excess is then T_f times the braces
/// over rho in all steps shorter than T_f, so the flow does not depend on the step [Choi99]. a_f is
/// 0 in the fluid and 1 on faces where c_f or alpha_f lambda_B G is at least 1e-7 of the stress.
/// The mirrored weights of Phi make its divergence the adjoint of the pressure's gradient but for
/// the skewness. With d_f = dt and c_f = 0 a step multiplies the divergence of u by 1 - M A^-1, A
/// the Laplacian of the compact gradients, M of the averaged ones. M is between 0 and 2 A on any
/// mesh, so no mode grows [Trias14]. The braces compare the averaged gradient of p with the compact
/// one, and c_f does the same for the elastic normal stress. They vanish for linear fields.
///
/// An alternating elastic normal stress makes a flux whose strain removes 8 d_f dt G lambda_B /
/// |d|^2 of it in a step. The term of d_f in lambda_B keeps that below 1. t_f is dt if c_f = 0.
/// Near a solid it is at most 0.02 |d| / |u_f|, since the jump at the surface makes a flux error in
/// proportion to t_f. From |c_f| = 0 to 1e-7 of the stress, t_f goes linearly from dt to that
/// bound.
///
/// With a density rho is that of the face, and the force on the cells is replaced by that on the
/// face (flow/density.hpp). If everything moves with one acceleration, Phi(u*) is right already,
/// and the sum of this part and the braces is zero. On the boundary the velocity is given, and
/// openings have the same form with p_b. On return every face of phi is set. u: owned and halo.
void predict_flux(FaceField<Real>& phi, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                  const std::vector<char>& open_face, const FluxTerms& terms,
                  const FaceWeights& weights, const Mesh& mesh);

/// Makes a flux divergence-free: Lap q = div phi*, phi = phi* - grad q . S, u = u* - grad q. q is
/// dt / rho_0 times the pressure increment. The matrix is constant, with one set-up in a run. With
/// a density
///
///   div(rho_0 / rho_f grad q) = div phi*,   u = u* - rho_0 grad q / rhohat.
///
/// The preconditioner of the conjugate gradients is that of the constant matrix. So the iterations
/// grow with the root of the ratio of the largest to the least density.
class Projection {
 public:
  /// correctors: extra solves for the non-orthogonal part, on meshes that have one. mirrors[i]:
  /// whether the pressure is symmetric about mesh.patches[i] (empty: false).
  Projection(const Mesh& mesh, const FaceWeights& weights, const std::vector<Condition>& conditions,
             Method method, int correctors, const std::vector<bool>& mirrors = {});

  /// phi: every face set. q_b: of q on openings. On return phi is divergence-free to the solver's
  /// tolerance, its sum over the boundary zero to round-off; q and grad_q (owned and halo) are what
  /// u and p are to be corrected with. absolute: see LinearSystem::solve, in units of volume per
  /// time. Errors: Error{numerics}.
  SolveResult project(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
                      const BoundaryField<Real>& q_b, Real absolute);

  /// Collective. From now on first projects the cell velocities. The compact gradients then take
  /// the rest of the divergence, and the pressure gradient is the adjoint (orthogonal.hpp). phi*
  /// must be Phi(u*) alone. stencil: of the velocity's gradient.
  void make_orthogonal(const GradientStencil& stencil, const std::vector<Condition>& conditions);
  /// Whether the projection is orthogonal.
  bool orthogonal() const { return orthogonal_.has_value(); }

  /// Collective. Uses that density from now on, until the next call. It must outlive this.
  void set_density(const Density& density);

  /// Collective. grad p, owned and halo, and at irregular faces (operators/gradient.hpp); p: owned
  /// and halo, p_b: at openings.
  void set_gradient(CellField<Vec3>& grad, const CellField<Real>& p,
                    const BoundaryField<Real>& p_b);
  /// Subtracts from e_f the part r_f = k . ((grad q)_f - (grad q')_f) of the last `project`, with
  /// q' of the solve before the last one. The last solve takes (grad q')_f, and the pressure that
  /// follows from q has (grad q)_f. So r_f is no excess that this pressure would hold. It belongs
  /// to the length of its step: part is the new length over the old one, at most 1.
  void subtract_oblique_rest(FaceField<Real>& excess, Real part) const;
  /// r_f of every face, part of a checkpoint; none on meshes without irregular faces.
  std::optional<FaceField<Real>>& oblique_rest() { return oblique_rest_; }
  /// At irregular faces, of the last `set_gradient`; `project` overwrites it.
  const std::vector<Vec3>& face_gradient() const { return grad_f_; }
  /// A given pressure counts as a value; on all other patches it is extrapolated to the boundary,
  /// on planes of symmetry with no slope along the normal.
  PressureStencil& stencil() { return stencil_; }
  /// Whether some patch gives the pressure.
  bool open() const { return open_; }

 private:
  SolveResult project_cells(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
                            const BoundaryField<Real>& q_b, Real absolute);
  void set_face_gradient(const CellField<Real>& q, const BoundaryField<Real>& q_b);
  void set_outflow(const FaceField<Real>& phi, const BoundaryField<Real>& q_b);
  /// To the right-hand side: k . (grad q)_f of the last `set_face_gradient`.
  void add_oblique_outflow();
  void subtract_gradient(FaceField<Real>& phi, const CellField<Real>& q,
                         const BoundaryField<Real>& q_b) const;
  /// To r_f its half of the last `face_gradient`: -1 before (grad q)_f is set, 1 after.
  void add_to_oblique_rest(Real sign);
  void balance_boundary(FaceField<Real>& phi) const;
  void close_balance(FaceField<Real>& phi, CellField<Real>& q) const;
  /// Sets the matrix and the conductance of the openings.
  void set(FaceMatrix& matrix);
  /// rho_0 / rho_f; 1 without a density.
  Real mobility(Index f) const {
    return density_ != nullptr ? density_->rho_0() / density_->of_face()[f] : 1;
  }

  const Mesh& mesh_;
  const FaceWeights& weights_;
  int correctors_;
  bool open_ = false;
  std::vector<char> open_face_, adjustable_;  // [n_boundary]
  Real adjustable_area_ = 0;
  Real conductance_ = 0;  // sum of g rho_0 / rho_f over the openings of all ranks
  const Density* density_ = nullptr;
  PressureStencil stencil_;
  CellField<Vec3> first_;     // the plain gradient, on irregular meshes
  std::vector<Vec3> grad_f_;  // at irregular faces
  std::optional<FaceField<Real>> oblique_rest_;
  std::vector<Real> b_;
  LinearSystem system_;
  std::optional<FaceMatrix> matrix_;  // with a density
  std::optional<Orthogonal> orthogonal_;
  std::optional<CellField<Real>> rest_;  // the potential of what `orthogonal_` leaves
};

/// A force per volume, owned and halo, with its counterpart c_f in the face flux; null: 0.
struct ForceOfFaces {
  const CellField<Vec3>* force = nullptr;   ///< of cells
  const FaceField<Real>* source = nullptr;  ///< c_f
};

/// phi_f = (rho_0 / rho_f) { Phi(force) + g c_f - (g (p_N - p_P) + k . (grad p)_f) }: the flux that
/// a force and the pressure make from rest in a unit of time, times rho_0. It is 0 where the
/// velocity is given. terms: p, grad_p_f, p_b and density are read; without a density rho_f is
/// rho_0.
void flux_of_rest(FaceField<Real>& phi, const ForceOfFaces& of, const std::vector<char>& open_face,
                  const FluxTerms& terms, const FaceWeights& weights, const Mesh& mesh);

/// div_c = sum_f phi_f / V of owned cells.
void divergence(CellField<Real>& div, const FaceField<Real>& phi, const Mesh& mesh);

/// max over owned cells of all ranks of |sum_f phi_f| / V.
Real divergence_max(const FaceField<Real>& phi, const Mesh& mesh);

/// Collective. (sum_f phi_f^2)^(1/2): what the rounding of a divergence is measured by.
Real size(const FaceField<Real>& phi, const Mesh& mesh);

}  // namespace fsi::flow
