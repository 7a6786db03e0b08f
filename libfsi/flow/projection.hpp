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

/// What enters the face flux besides u*.
struct FluxTerms {
  const std::vector<Tensor>& L_f;           ///< of u*, at irregular faces; of u^n beside a surface
  const CellField<Real>& p;                 ///< pressure at the cells
  const CellField<Vec3>& grad_p;            ///< its averaged gradient
  const std::vector<Vec3>& grad_p_f;        ///< of p at irregular faces
  const BoundaryField<Real>& p_b;           ///< read on openings only
  const FaceField<Real>& rhie_chow_source;  ///< elastic counterpart c_f (s_N - s_P) - (grad s)_f .
                                            ///< d; 0 outside the solid
  const FaceField<Real>& mu;                ///< viscosity at the faces
  const FaceField<Real>& theta;             ///< implicit share of the viscous term
  const FaceField<Real>& kappa;    ///< implicit besides the viscosity; 0 away from the solid
  const FaceField<Real>& elastic;  ///< what of it stands in for elasticity
  /// Density of the fluid; length of the step.
  Real rho = 1, dt = 0;
  const Density* density = nullptr;        ///< none: rho everywhere
  const CellField<Vec3>* force = nullptr;  ///< of all cells; read with a density only
  Real stress = 0;                         ///< scale of the elastic stress; 0: there is none
  Real flux_strain =
      0;  ///< dt G alpha_f lambda_B / elastic where the flux strains the solid; 0: it does not
};

/// Balanced, damped Rhie-Chow flux [Rhie83]:
///   phi = U(u*)_f . S + d_f { U(grad p)_f . S - (g (p_N - p_P) + k . (grad p)_f) + g c_f },
///   U(u)_f = lambda u_P + (1 - lambda) u_N (+ L_f . (x_f - x_m) for u*),
///   d_f = t_f / (rho + 4 t_f (theta mu_f + kappa_f + 2 dt G alpha_f lambda_B) / |d|^2).
/// Each cell has the weight of its own part of the way, x_m = x_P + (1 - lambda) d. Then the sum
/// over faces of U . S and the pressure's gradient are adjoint but for the skewness. With d_f = dt
/// and c_f = 0 a step multiplies the divergence of u by 1 - M A^-1, A the Laplacian of the compact
/// gradients, M of the averaged ones. M is between 0 and 2 A on any mesh, so nothing grows
/// [Trias14]. The brace compares the compact with the averaged gradient of p and of the elastic
/// normal stress; it vanishes for linear fields. The last part of d_f stands where the flux strains
/// the solid. There an elastic normal stress that alternates from cell to cell makes a flux whose
/// strain takes 8 d_f dt G lambda_B / |d|^2 of it off in a step, no more than all of it. t_f = dt,
/// but where elastic stress acts not more than 0.02 |d| / |u_f|, gradually from none of c_f to 1e-7
/// of the stress. Else the jump at the surface of a solid would leak through it with a flux in
/// proportion to dt. With a density rho is that of the face, and what the cells make of all forces
/// is taken out for what the face makes of them (flow/density.hpp). Where everything moves with one
/// acceleration U(u*) is right already, and this with the brace is zero. Boundary: prescribed
/// velocity, or the same with p_b at openings. On return every face of phi is set. u: owned and
/// halo.
void predict_flux(FaceField<Real>& phi, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                  const std::vector<char>& open_face, const FluxTerms& terms,
                  const FaceWeights& weights, const Mesh& mesh);

/// Makes a flux divergence-free: Lap q = div phi*, phi = phi* - grad q . S, u = u* - grad q. q is
/// dt / rho_0 times the pressure increment. The matrix is constant: one set-up a run. With a
/// density
///
///   div(rho_0 / rho_f grad q) = div phi*,   u = u* - rho_0 grad q / D,
///
/// by conjugate gradients preconditioned with what the constant matrix was set up for: it needs as
/// many iterations as rho varies, about the root of the largest over the least times as many.
class Projection {
 public:
  /// correctors: extra solves for the non-orthogonal part, on meshes that have one.
  Projection(const Mesh& mesh, const FaceWeights& weights, const std::vector<Condition>& conditions,
             Method method, int correctors);

  /// phi: every face set. q_b: of q on openings. On return phi is divergence-free to the solver's
  /// tolerance, its sum over the boundary zero to round-off; q and grad_q (owned and halo) are what
  /// u and p are to be corrected with. absolute: see LinearSystem::solve, in units of volume per
  /// time. Errors: Error{numerics}.
  SolveResult project(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
                      const BoundaryField<Real>& q_b, Real absolute);

  /// Collective. From now on first projects the cells' own velocities, and the compact gradients
  /// take what of the divergence that leaves; the pressure gradient is the adjoint
  /// (orthogonal.hpp). phi* must be what U makes of u* alone. stencil: of the velocity's gradient.
  void make_orthogonal(const GradientStencil& stencil, const std::vector<Condition>& conditions);
  /// Whether it does.
  bool orthogonal() const { return orthogonal_.has_value(); }

  /// Collective. Takes that density from now on, until it is renewed. It must outlive this.
  void set_density(const Density& density);

  /// Collective. grad p, owned and halo, and at irregular faces (operators/gradient.hpp); p: owned
  /// and halo, p_b: at openings.
  void set_gradient(CellField<Vec3>& grad, const CellField<Real>& p,
                    const BoundaryField<Real>& p_b);
  /// At irregular faces, of the last `set_gradient`; `project` overwrites it.
  const std::vector<Vec3>& face_gradient() const { return grad_f_; }
  /// Where the pressure is given it counts as a value, elsewhere it is extrapolated to the wall.
  PressureStencil& stencil() { return stencil_; }
  /// Whether some patch gives the pressure.
  bool open() const { return open_; }

 private:
  SolveResult project_cells(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
                            const BoundaryField<Real>& q_b, Real absolute);
  void set_face_gradient(const CellField<Real>& q, const BoundaryField<Real>& q_b);
  void set_outflow(const FaceField<Real>& phi, const BoundaryField<Real>& q_b);
  void subtract_gradient(FaceField<Real>& phi, const CellField<Real>& q,
                         const BoundaryField<Real>& q_b) const;
  void balance_boundary(FaceField<Real>& phi) const;
  void close_balance(FaceField<Real>& phi, CellField<Real>& q) const;
  /// With it the conductance of the openings.
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
  std::vector<Real> b_;
  LinearSystem system_;
  std::optional<FaceMatrix> matrix_;  // with a density
  std::optional<Orthogonal> orthogonal_;
  std::optional<CellField<Real>> rest_;  // the potential of what `orthogonal_` leaves
};

/// phi_f = (rho_0 / rho_f) { U(force) . S + g c_f - (g (p_N - p_P) + k . (grad p)_f) }. This is the
/// flux that forces and pressure make in a unit of time out of rest, times rho_0. It is 0 where the
/// velocity is given. terms: p, its gradients, p_b, c_f, density and force are read.
void flux_of_rest(FaceField<Real>& phi, const std::vector<char>& open_face, const FluxTerms& terms,
                  const FaceWeights& weights, const Mesh& mesh);

/// div_c = sum_f phi_f / V of owned cells.
void divergence(CellField<Real>& div, const FaceField<Real>& phi, const Mesh& mesh);

/// p_c -= chi mu_c div u*, mu_c the least theta mu + kappa of the cell's faces: what the implicit
/// viscous term makes of the correction grad q. chi = 1/2, less in cells of poor shape. div: of the
/// predicted flux, owned. p: owned and halo.
void add_viscous_pressure(CellField<Real>& p, const CellField<Real>& div, const FaceField<Real>& mu,
                          const FaceField<Real>& kappa, const FaceField<Real>& theta,
                          const FaceWeights& weights, const Mesh& mesh);

/// max over owned cells of all ranks of |sum_f phi_f| / V.
Real divergence_max(const FaceField<Real>& phi, const Mesh& mesh);

}  // namespace fsi::flow
