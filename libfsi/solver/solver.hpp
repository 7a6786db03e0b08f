#pragma once
// The step: the only place that knows the order of the equations.

#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libfsi/core/profile.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/field/of_place_and_time.hpp"
#include "libfsi/flow/bulk_friction.hpp"
#include "libfsi/flow/courant.hpp"
#include "libfsi/flow/density.hpp"
#include "libfsi/flow/forcing.hpp"
#include "libfsi/flow/loads.hpp"
#include "libfsi/flow/momentum.hpp"
#include "libfsi/flow/openings.hpp"
#include "libfsi/flow/projection.hpp"
#include "libfsi/flow/viscous_pressure.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/solver/backup.hpp"
#include "libfsi/solver/body.hpp"
#include "libfsi/solver/calls.hpp"
#include "libfsi/solver/side_gradients.hpp"
#include "libfsi/solver/solid_step.hpp"
#include "libfsi/solver/state.hpp"
#include "libfsi/vof/separate.hpp"

namespace fsi {

struct Rejection;

/// Advances a State by the calls of doc/theory/step.md; the kinematics of the paper's scheme is
/// left_cauchy_green. Holds what a step needs so that a step allocates nothing.
class Solver {
 public:
  /// Collective. mesh must outlive the solver.
  Solver(const Mesh& mesh, const Physics& physics, const FlowSetup& setup);

  /// Collective. Sets the velocity at t = 0 and makes its flux divergence-free. The pressure is
  /// that of fluid at rest between the openings, Lap p = 0; without openings it stays as it is.
  void start(const std::function<Vec3(const Vec3&)>& u_0);

  /// Collective. Puts a solid into the fluid, undeformed; any number of times, each with a name of
  /// its own where there are several. One that is put in between two steps moves with the fluid
  /// that is there. An Output watches the solids that were there when it was made: end it first
  /// (Output). No solid is taken out again. Errors: Error{input} where it is empty, leaves the
  /// mesh, overlaps another, has another's name or a material out of bounds; the solver is then as
  /// before.
  void put_solid(const Solid& solid);

  /// Collective. From t to t + dt. Errors: Error{numerics}; the state is then undefined.
  /// Error{numerics} where the patches prescribe more or less inflow than outflow at t + dt;
  /// nothing is changed. Error{input} where dt is not above 0 and finite, or a body was taken out
  /// of `bodies`; nothing is changed.
  void step(Real dt);

  /// Collective. A step of dt or, where that fails, of a half, a quarter ... of it from the same
  /// state, with at most eight halvings. A step fails when it throws or when what it leaves behind
  /// is out of bounds (advance.cpp); the steps after it grow by a tenth each. Returns the length
  /// taken; 0 when all failed: report().failure then says why and the state is that before the
  /// step. Errors: Error{input} as those of `step`; Error{numerics} where the call before
  /// returned 0 and dt is the same, so a loop that does not look at what is returned ends.
  Real advance(Real dt);

  /// Collective. Brings a solid that stands between two steps to the state's time. The next step
  /// goes on from there.
  void synchronise();
  /// Collective. Calls `use` with the solids at the state's time, for fields that belong together,
  /// and takes the solids back: the next step is the same to the last bit.
  void at_one_time(const std::function<void()>& use);

  /// What each call of `step` does in this scene, a line a call; "nothing" where the scene does not
  /// need it.
  std::vector<std::string> describe_step() const;

  /// Adds all that the next step depends on to a checkpoint's list. After the solid is put in.
  void list(io::Snapshot& snapshot);
  /// Collective. Renews what follows from the listed state, once that was read.
  void resume();

  /// Collective. Largest dt with Courant number (dt / 2V) sum |phi| below `courant` in every cell.
  /// A triangle or tetrahedron has that of its neighbourhood (flow::Courant).
  Real advective_dt(Real courant) const;
  /// Collective. How long a step may be for explicit upwind convection; the largest number with
  /// central convection.
  Real upwind_dt() const { return courant_.upwind_dt(state_.phi, modes_.implicit_convection); }
  /// Collective. How long the next step may be for what the conditions and the body force give over
  /// time, in a run to `end` (`step_of`, OfPlaceAndTime).
  Real conditions_dt(Real end) const;
  /// Collective. Largest dt that moves the solids by a Courant number of one at most, in this step
  /// and in half of the last one and half of this. Beside viscous ones:
  /// SurfaceTraction::courant_max at most.
  Real carried_dt() const;
  /// Collective. Largest dt in which nothing that moves at a boundary passes more than `courant` of
  /// the cell beside it: what is known of the flow before the first step.
  Real boundary_dt(Real courant) const;
  /// The step of which so many bring the Courant number to `courant`, where `start` left the fluid
  /// at rest and pressure and body force accelerate it; else the largest number.
  Real acceleration_dt(Real courant, int steps) const;
  /// Collective. The largest step that resolves the solid's elastic waves, or, where these are
  /// treated implicitly, that was found stable; the largest number without a solid.
  Real elastic_dt() const;
  /// The same of one solid.
  Real elastic_dt(const Body& body) const;
  /// Collective. Step in which the solid strains by that much at its last rate, where the
  /// kinematics watches it.
  Real strain_dt(Real strain) const;

  /// Steps since the start, or since a solid was put in.
  std::int64_t steps() const { return state_.step - begun(); }
  /// The time of the start, or that at which the last solid was put in.
  Real t_begun() const;

  /// The mesh.
  const Mesh& mesh() const { return mesh_; }
  ///@{
  /// The unknowns of the flow.
  State& state() { return state_; }
  const State& state() const { return state_; }
  ///@}
  ///@{
  /// The solids, in the order they were put in. The list itself grows by put_solid alone.
  std::deque<Body>& bodies() { return bodies_; }
  const std::deque<Body>& bodies() const { return bodies_; }
  ///@}
  ///@{
  /// The first of them; none in a scene without.
  Body* body() { return bodies_.empty() ? nullptr : &bodies_.front(); }
  const Body* body() const { return bodies_.empty() ? nullptr : &bodies_.front(); }
  ///@}
  /// Largest sum of the solids' fractions in a cell of the last step, less 1; at least 0.
  Real overlap() const { return separation_ ? separation_->overlap() : 0; }
  /// Densities and viscosities.
  const Physics& physics() const { return physics_; }
  /// None where all solids are as dense as the fluid.
  const flow::Density* density() const { return heavy_ ? &heavy_->density : nullptr; }
  ///@{
  /// The last step.
  StepReport& report() { return report_; }
  const StepReport& report() const { return report_; }
  ///@}
  /// Wall time of the calls.
  const Profile& profile() const { return profile_; }
  /// Velocity at the boundary.
  const BoundaryField<Vec3>& u_b() const { return u_b_; }
  /// Pressure at the boundary.
  const BoundaryField<Real>& p_b() const { return p_b_; }
  /// Gradient of the pressure that the last step began with.
  const CellField<Vec3>& pressure_gradient() const { return grad_p_; }
  /// Viscosity at the faces, of the last step.
  const FaceField<Real>& mu() const { return mu_; }
  /// Velocity gradient at the irregular faces (FaceWeights::place), of u* of the last step.
  const std::vector<Tensor>& L_f() const { return L_f_; }
  /// Weights of the faces.
  const FaceWeights& weights() const { return weights_; }
  /// Weights of the velocity's gradient.
  const GradientStencil& u_stencil() const { return u_stencil_; }
  /// The velocity's derivative at the walls, of the last step.
  const flow::WallParabola& wall_parabola() const { return wall_parabola_; }
  /// Force per volume on fluid and solid; empty where there is none.
  const std::function<Vec3(const Vec3&, Real)>& driving_force() const { return driving_force_; }
  /// What is given at an opening in the middle of the last step, behind its load's answer.
  /// Errors: Error{input} where that patch is none.
  Real opening_pressure(const std::string& patch) const;
  /// Conditions by patch, in the order of the mesh.
  const std::vector<Condition>& conditions() const { return conditions_; }
  /// Velocity gradient at the state's time; collective.
  const CellField<Tensor>& velocity_gradient();
  /// Driving pressure gradient S; zero without a mean velocity.
  Real driving_gradient() const { return forcing_ ? forcing_->gradient : 0; }
  /// Whether a mean velocity is held.
  bool holds_mean_velocity() const { return forcing_.has_value(); }
  /// Of the mean velocity, a unit vector.
  Vec3 axis() const { return axis_; }
  /// Volume mean of the velocity along the axis; collective.
  Real mean_velocity() const { return flow::mean_velocity(state_.phi, axis_, mesh_); }

 private:
  /// Errors: Error{input} where `bodies` is not what was put in.
  void require_bodies() const;
  /// Errors: Error{input} where that is no length of a step.
  void require_length(Real dt) const;
  /// Collective. Errors: those of `require_length`; Error{numerics} where not `balanced` at its
  /// end.
  void require_step(Real dt);
  /// Collective. Whether as much flows in as out at t; else says in the report why not.
  bool balanced(Real t);
  /// Whether some body's interface is at another time than the flow.
  bool stands_apart() const;
  void set_pressure_of_rest();
  void add_pressure_of_body_force();
  /// Collective. Courant number per time squared that the fluid at rest is given; 0 for one in
  /// motion.
  Real acceleration_rate() const;
  /// The step of the flow in which the last solid was put in.
  std::int64_t begun() const;
  // The calls of a step: doc/theory/step.md. What each sets stands first.
  void hold_shape(Body& body);
  void advance_interface(Body& body, Real t);
  void separate_bodies();
  void advect_pressure_jump(CellField<Real>& p, const Body& body);
  void set_pressure_gradient(CellField<Vec3>& grad_p, const State& state);
  void set_velocity_gradient(CellField<Tensor>& L, const State& state);
  void clear_forces();
  void transport_memory(Body& body, CellField<Tensor>& L);
  void transport_elastic(CellField<Tensor>& L);
  void mix_viscosity(FaceField<Real>& mu);
  void mix_density();
  void add_elastic_force(CellField<Vec3>& force, Body& body);
  void add_semi_implicit(FaceField<Real>& kappa, FaceField<Real>& stiffness, CellField<Vec3>& force,
                         Real dt);
  void add_body_force(CellField<Vec3>& force, Real t);
  void balance_weight(State& state);
  /// Adds to p what balances that force, or the weight of the solids just put in.
  void add_pressure_of_rest(State& state, const CellField<Vec3>& force,
                            const FaceField<Real>& source);
  void add_pressure_of_new_weight(State& state);
  void set_flux_of_pressure(const State& state);
  void set_flux_excess(const State& state, Real dt);
  void predict_momentum(CellField<Vec3>& u, Real dt);
  void predict_flux(FaceField<Real>& phi, const CellField<Vec3>& u, Real dt);
  /// What the flux at the faces takes over a step of dt; with 0 that of a given velocity alone.
  flow::FluxTerms flux_terms(Real dt) const;
  void project(State& state, Real dt);
  void hold_mean_velocity(State& state, Real dt);
  void check(const State& state);
  /// phi_1 of the mean velocity and the responses to loads belong to this density.
  void renew_responses();
  /// What the calls on bodies read of the flow.
  FlowAround flow_around();
  /// Velocity at the boundary at time t; L and L_f_ of u and it, where they are needed.
  void set_gradient(CellField<Tensor>& L, BoundaryField<Vec3>& u_b, Real t);
  /// Between two cells with a one-sided L beside the surface, L_f_ is the mean of both.
  void take_interface_gradient(const Body& body, const CellField<Tensor>& L);
  /// Against what a step of dt leaves behind; empty where there is nothing.
  Rejection rejection_reason(Real dt) const;
  /// Where the state as it stands is worst in that respect: a sentence with figure, place and cell.
  std::string diagnosis(const Rejection& rejection, Real dt);
  /// Counts steps so short that the run will not end; whether there were too many in a row.
  bool stuck(Real dt);
  /// What the bodies ask of a step, set as they are put in.
  struct Modes {
    bool mu_varies = false;            ///< some solid's viscosity is not the fluid's
    bool films = false;                ///< mu at walls depends on the films of the solids
    bool stiff = false;                ///< elasticity or convection is partly implicit
    bool implicit_convection = false;  ///< where cells are smaller than those around them
    bool one_sided = false;            ///< some solid has a one-sided L at its surface
    Real G = 0;                        ///< the largest
    Real rho_least = std::numeric_limits<Real>::max();  ///< of fluid and solids
  };
  /// What a body just put in asks for.
  void set_modes(const Body& body);
  /// Whether the momentum equation needs the velocity gradient in all cells.
  bool needs_L() const {
    return weights_.uneven || momentum_.reads_L() || modes_.mu_varies || modes_.one_sided;
  }
  /// omega of the walls beside the solids.
  void set_wall_parabola();
  /// What the momentum equation takes implicitly besides the viscosity.
  const FaceField<Real>& implicit() const { return stiff_ ? *stiff_ : kappa_; }
  /// The Courant number per time of that flux that limits a step.
  Real courant_rate_max(const FaceField<Real>& phi) const;
  /// Collective. That of every owned cell.
  std::vector<Real> courant_rates() const;
  /// kappa_w of bulk_friction.hpp, of the least viscous and the heaviest of fluid and solids.
  Real friction() const;
  Real explicit_courant() const {
    return modes_.implicit_convection ? courant_.explicit_part() : std::numeric_limits<Real>::max();
  }
  void make_orthogonal();
  void hold_backup();
  void keep_backup();
  const Mesh& mesh_;
  Physics physics_;
  std::vector<Condition> conditions_;
  Vec3 axis_;
  std::function<Vec3(const Vec3&, Real)> driving_force_;
  std::vector<OfPlaceAndTime> over_time_;  // velocities at the boundary, force
  FaceWeights weights_;
  flow::Courant courant_;
  State state_;
  BoundaryField<Vec3> u_b_, u_b_new_;
  BoundaryField<Real> p_b_;
  BoundaryField<Real> q_b_;
  CellField<Vec3> grad_p_, grad_q_, force_;
  CellField<Tensor> L_;
  CellField<Real> q_, divergence_;
  FaceField<Real> mu_, kappa_, stiffness_, rhie_chow_source_, excess_;
  GradientStencil u_stencil_;
  VertexMean<Tensor> vertex_mean_;
  std::vector<Tensor> L_f_;             // at irregular faces
  Kinks kinks_{mesh_};                  // of u at the surfaces
  std::vector<Index> interface_faces_;  // irregular faces beside the surface, where L_f_ is
  std::vector<Tensor> interface_L_f_;   // one-sided, and that gradient
  flow::Openings openings_;
  flow::Projection projection_;
  flow::Loads loads_;
  flow::ViscousPressure viscous_pressure_;
  flow::BulkFriction bulk_friction_;
  Real friction_ = 0;  // of flow along the walls, per viscosity; 0: none is needed
  flow::WallParabola wall_parabola_;
  flow::Momentum momentum_;
  std::optional<flow::Forcing> forcing_;
  std::deque<Body> bodies_;
  Modes modes_;
  std::optional<FaceField<Real>> stiff_;     // kappa_ and what two viscosities and courant_ add
  std::optional<CellField<Real>> mixed_mu_;  // of the cells, where there are several solids
  /// The density and what it needs, where some solid's is not the fluid's.
  struct Heavy {
    Heavy(const Mesh& mesh, const FaceWeights& weights, Real rho)
        : density(mesh, weights, rho), acceleration(mesh) {}
    flow::Density density;
    CellField<Vec3> acceleration;  // of the cells by all forces, in a step
  };
  std::optional<Heavy> heavy_;
  /// What `balance_weight` works with.
  struct AtRest {
    const Mesh& mesh;
    CellField<Vec3> weight{mesh};
    FaceField<Real> flux{mesh}, of_flow{mesh}, source{mesh}, oblique_rest{mesh};
    BoundaryField<Real> q_b{mesh};  // stays 0
  };
  std::optional<AtRest> at_rest_;  // for forces and weights; none in an orthogonal projection
  std::optional<vof::Separation> separation_;  // where there are several solids
  std::vector<vof::Fractions> fractions_;      // of the bodies
  std::vector<Index> shared_;                  // owned cells that several bodies may hold
  std::optional<StrainByFlux> by_flux_;
  std::optional<SideGradients> side_gradients_;  // several solids, some one-sided
  bool leaves_ = false;                          // whether a solid may leave the mesh
  bool prescribed_ = false;                      // whether all that flows in and out is given
  Real passed_ = 0;                              // the most of it so far
  std::optional<Backup> backup_;
  Real dt_cap_ = std::numeric_limits<Real>::max();  // after a rejected step
  Real dt_largest_ = 0;                             // of this run
  Real start_rate_ = 0;                             // acceleration_rate() at the start
  std::int64_t failed_step_ = -1;                   // that of the last call of advance
  Real failed_dt_ = 0;                              // its length, as asked
  int tiny_steps_ = 0;                              // in a row
  Real cells_norm_ = 0;                             // sqrt(sum V^2)
  StepReport report_;
  Profile profile_;
  Calls calls_;
};

}  // namespace fsi
