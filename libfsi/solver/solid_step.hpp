#pragma once
// The calls of a step on one solid, for Solver and for a loop of one's own (doc/howto/own_loop.md).
// The numbers are those of doc/theory/step.md. The first arguments are those that a call sets.

#include <vector>

#include "libfsi/solver/body.hpp"

namespace fsi {

/// Scratch of a solid whose strain is corrected by the fluxes (Body::strain_by_flux): the velocity
/// utilde of solid/solenoidal.hpp, at the boundary too, and its gradient.
struct StrainByFlux {
  /// Zero fields; mesh must outlive them.
  explicit StrainByFlux(const Mesh& mesh) : u(mesh), u_b(mesh), L(mesh) {}
  CellField<Vec3> u;        ///< utilde
  BoundaryField<Vec3> u_b;  ///< on the boundary
  CellField<Tensor> L;      ///< its gradient
};

/// The flow that carries and strains the solids, and on which they act, at t^n; cell fields owned
/// and halo.
struct FlowAround {
  const CellField<Vec3>& u;          ///< velocity
  const FaceField<Real>& phi;        ///< flux
  const BoundaryField<Vec3>& u_b;    ///< velocity at the boundary
  const std::vector<char>& open;     ///< [n_boundary] 1 on openings (Momentum::boundary)
  const GradientStencil& u_stencil;  ///< with values where the velocity is given
  PressureStencil& pressure;         ///< of the projection
  const std::vector<Tensor>& L_f;    ///< at irregular faces
  const FaceField<Real>& mu;         ///< viscosity, as in the momentum equation
  StrainByFlux* by_flux = nullptr;   ///< for solids with Body::strain_by_flux
  Real rho_least = 1;                ///< the least density of fluid and solids
  bool has_L = false;  ///< L = grad u is set in all cells; else the calls set it where they need it
  bool leaves = false;  ///< a solid may leave through the boundary
};

/// (1) Collective. Moves alpha and its planes towards the shape of the body's map, if it has one.
void hold_shape(Body& body);

/// (2) Collective. Carries alpha and its planes on to time t by the flow, in parts of a Courant
/// number of 0.2, and sets alpha_mid.
void advance_interface(Body& body, const FlowAround& flow, Real t);

/// (4) Collective. Moves the jump of the pressure with the surface. p: owned and halo.
void advect_pressure_jump(CellField<Real>& p, const Body& body);

/// (7) Collective. Carries the memory, if there is one, in two halves where `advance_interface`
/// took two parts or more. Sets L on its cells if the flow has none.
void transport_memory(Body& body, CellField<Tensor>& L, const FlowAround& flow);

/// (8) Collective. Strains the body over the time of `advance_interface`, and sets anew what
/// follows from alpha and B. Sets L on the known cells if the flow has none. Errors:
/// Error{numerics} if B is beyond the range of the law.
void transport_elastic(Body& body, CellField<Tensor>& L, const FlowAround& flow);

/// (11) Collective. Adds the elastic force and its counterpart in the face flux, the traction
/// between two viscosities and the body force, where there are such.
void add_elastic_force(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, Body& body,
                       const CellField<Tensor>& L, const FlowAround& flow);

/// Collective. Its last part: the weight and body force of a body that has one.
void add_weight(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, Body& body,
                PressureStencil& pressure);

/// (12) Collective. Adds the two terms that keep a step of dt stable, if elasticity is implicit in
/// part, and dt G alpha_f lambda_B to the stiffness. kappa and stiffness: cleared by
/// Body::semi_implicit_elasticity before. Sets L on the band and its halo if the flow has none, and
/// leaves it elsewhere.
void add_semi_implicit(FaceField<Real>& kappa, FaceField<Real>& stiffness, CellField<Vec3>& force,
                       Body& body, CellField<Tensor>& L, const FlowAround& flow, Real dt);
/// (16) Adds the kinks of u at the body's surface, which linear convection reads: none of a body
/// that bears no stress and has the fluid's viscosity, or with left_cauchy_green. After
/// `add_semi_implicit`, which sets L where the flow does not.
void add_kinks(Kinks& kinks, const Body& body, const CellField<Tensor>& L, Real mu_f);

}  // namespace fsi
