#pragma once
// Face fluxes and the pressure correction.

#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/operators/linear_system.hpp"

namespace fsi::flow {

/// What enters the face flux besides u*.
struct FluxTerms {
  const CellField<Real>& p;
  const CellField<Vec3>& grad_p;
  const BoundaryField<Real>& p_b;  ///< read on openings only
  const CellField<Tensor>& L;      ///< velocity gradient, read on skewed meshes only
  const FaceField<Real>&
      balance;  ///< elastic counterpart c_f (s_N - s_P) - (grad s)_f . d; 0 outside the solid
  const FaceField<Real>& mu;
  const FaceField<Real>& kappa;    ///< implicit besides the viscosity; 0 away from the solid
  const FaceField<Real>& elastic;  ///< what of it stands in for elasticity
  Real theta = 0.5, rho = 1, dt = 0;
  Real strained = 0;  ///< dt G lambda_B / elastic where the flux strains the solid; 0: it does not
};

/// Balanced, damped Rhie-Chow flux [Rhie83]:
///   phi = (u*)_f . S + d_f g { (grad p)_f . d - (p_N - p_P) + c_f },
///   d_f = t_f / (rho + 4 t_f (theta mu_f + kappa_f + 2 dt G lambda_B) / |d|^2),
/// the last where the flux strains the solid: an elastic normal stress that alternates from cell to
/// cell makes a flux whose strain takes 8 d_f dt G lambda_B / |d|^2 of it off in a step, no more
/// than all of it. t_f = dt, but where elastic stress acts not more than 0.02 |d| / |u_f|: the jump
/// at the surface of a solid would else leak through it with a flux in proportion to dt. The brace
/// compares the compact with the averaged gradient of p and of the elastic normal stress; it
/// vanishes for linear fields. Boundary: prescribed velocity, or the same with p_b at openings. On
/// return every face of phi is set. u: owned and halo.
void predict_flux(FaceField<Real>& phi, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                  const std::vector<char>& open_face, const FluxTerms& terms,
                  const FaceWeights& weights, const Mesh& mesh);

/// Makes a flux divergence-free: Lap q = div phi*, phi = phi* - grad q . S, u = u* - grad q. q is
/// dt / rho times the pressure increment. The matrix is constant: one set-up a run.
class Projection {
 public:
  /// correctors: extra solves for the non-orthogonal part, on meshes that have one.
  Projection(const Mesh& mesh, const FaceWeights& weights, const std::vector<Condition>& conditions,
             Method method, int correctors);

  /// phi: every face set. On return phi is divergence-free to the solver's tolerance; q and grad_q
  /// (owned and halo) are what u and p are to be corrected with. absolute: see LinearSystem::solve,
  /// in units of volume per time. scratch: overwritten. Errors: Error{numerics}.
  Solve project(FaceField<Real>& phi, CellField<Real>& q, CellField<Vec3>& grad_q,
                CellField<Vec3>& scratch, Real absolute);

  /// Collective. grad p, owned and halo (operators/gradient.hpp); p: owned and halo, p_b: at
  /// openings. scratch: overwritten.
  void set_gradient(CellField<Vec3>& grad, CellField<Vec3>& scratch, const CellField<Real>& p,
                    const BoundaryField<Real>& p_b) const {
    pressure_gradient(grad, scratch, p, p_b, stencil_, mesh_);
  }
  /// Where the pressure is given it counts as a value, elsewhere it is extrapolated to the wall.
  const GradientStencil& stencil() const { return stencil_; }
  /// Whether some patch gives the pressure.
  bool open() const { return open_; }

 private:
  void outflow(const FaceField<Real>& phi, const CellField<Vec3>& grad_q, bool correct);
  void balance_boundary(FaceField<Real>& phi) const;

  const Mesh& mesh_;
  const FaceWeights& weights_;
  int correctors_;
  bool open_ = false;
  std::vector<char> open_face_, adjustable_;  // [n_boundary]
  Real adjustable_area_ = 0;
  GradientStencil stencil_;
  BoundaryField<Real> zero_;
  std::vector<Real> b_;
  LinearSystem system_;
};

/// div_c = sum_f phi_f / V of owned cells.
void divergence(CellField<Real>& div, const FaceField<Real>& phi, const Mesh& mesh);

/// p_c -= chi mu_c div u*, mu_c the least theta mu + kappa of the cell's faces: what the implicit
/// viscous term makes of the correction grad q. chi = 1/2, less in cells of poor shape. div: of the
/// predicted flux, owned. p: owned and halo.
void add_viscous_pressure(CellField<Real>& p, const CellField<Real>& div, const FaceField<Real>& mu,
                          const FaceField<Real>& kappa, Real theta, const FaceWeights& weights,
                          const Mesh& mesh);

/// max over owned cells of all ranks of |sum_f phi_f| / V.
Real divergence_max(const FaceField<Real>& phi, const Mesh& mesh);

}  // namespace fsi::flow
