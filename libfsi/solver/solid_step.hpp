#pragma once
// What a step does with one solid, for Solver and for a loop of one's own (doc/howto/own_loop.md).
// The numbers are those of doc/theory/step.md; what a call sets stands first.

#include <vector>

#include "libfsi/solver/body.hpp"

namespace fsi {

/// Scratch of a strain in which the flux takes part (Body::strain_by_flux): the velocity with what
/// the fluxes tell besides, and its gradient.
struct StrainByFlux {
  /// Zero fields; mesh must outlive them.
  explicit StrainByFlux(const Mesh& mesh) : u(mesh), L(mesh) {}
  CellField<Vec3> u;    ///< velocity
  CellField<Tensor> L;  ///< its gradient
};

/// The flow that carries and strains the solids and that they push, at t^n; cell fields owned and
/// halo.
struct FlowAround {
  const CellField<Vec3>& u;          ///< velocity
  const FaceField<Real>& phi;        ///< flux
  const BoundaryField<Vec3>& u_b;    ///< velocity at the boundary
  const std::vector<char>& open;     ///< [n_boundary] 1 on openings (Momentum::boundary)
  const GradientStencil& u_stencil;  ///< with values where the velocity is given
  PressureStencil& pressure;         ///< of the projection
  const std::vector<Tensor>& L_f;    ///< at irregular faces
  const FaceField<Real>& mu;         ///< as the momentum equation has it
  StrainByFlux* by_flux = nullptr;   ///< where some solid's strain needs it
  Real rho_least = 1;                ///< the least density of fluid and solids
  bool has_L = false;  ///< L = grad u is set in all cells; else the calls set it where they need it
  bool leaves = false;  ///< a solid may leave through the boundary
};

/// (1) Collective. Holds alpha and its planes to the shape that the body's map tells, where it has
/// one.
void hold_shape(Body& body);

/// (2) Collective. Carries alpha and its planes on to time t by the flow, in parts of a Courant
/// number of 0.2, and sets alpha_mid.
void advance_interface(Body& body, const FlowAround& flow, Real t);

/// (4) Collective. Carries the jump of the pressure at the surface on with it. p: owned and halo.
void advect_pressure_jump(CellField<Real>& p, const Body& body);

/// (7) Collective. Carries the map to the undeformed solid on, where one goes beside log B. Sets L
/// on its cells where the flow has none.
void transport_memory(Body& body, CellField<Tensor>& L, const FlowAround& flow);

/// (8) Collective. Strains the body over the time that `advance_interface` carried it and renews
/// what follows from alpha and B. Sets L on the cells that strain where the flow has none.
/// Errors: Error{numerics} where B is beyond the range of the law.
void transport_elastic(Body& body, CellField<Tensor>& L, const FlowAround& flow);

/// (11) Collective. Adds the elastic force and its counterpart in the face flux, the traction
/// between two viscosities and the body force, where there are such.
void add_elastic_force(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, Body& body,
                       const CellField<Tensor>& L, const FlowAround& flow);

/// (12) Collective. Adds what keeps a step of dt stable, where elasticity is partly implicit.
/// kappa: cleared by Body::semi_implicit_elasticity before. Sets L on the band where the flow has
/// none.
void add_semi_implicit(FaceField<Real>& kappa, CellField<Vec3>& force, Body& body,
                       CellField<Tensor>& L, const FlowAround& flow, Real dt);

}  // namespace fsi
