#pragma once
// The step: the only place that knows the order of the equations.

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libfsi/core/clock.hpp"
#include "libfsi/core/profile.hpp"
#include "libfsi/field/boundary.hpp"
#include "libfsi/flow/forcing.hpp"
#include "libfsi/flow/loads.hpp"
#include "libfsi/flow/momentum.hpp"
#include "libfsi/flow/openings.hpp"
#include "libfsi/flow/projection.hpp"
#include "libfsi/operators/gradient.hpp"
#include "libfsi/solid/body_force.hpp"
#include "libfsi/solid/surface_traction.hpp"
#include "libfsi/solver/backup.hpp"
#include "libfsi/solver/body.hpp"

namespace fsi {

/// Material constants, in consistent units.
struct Physics {
  Real rho = 1;               ///< density of fluid and solid
  Real mu_f = 0.01;           ///< dynamic viscosity of the fluid
  Real mu_s = 0.01;           ///< of the solid
  Real G = 0;                 ///< shear modulus of the solid
  Vec3 solid_acceleration{};  ///< of a body force that acts on the solid alone
  solid::Law law{};           ///< of the solid's elastic stress
};

/// What drives and how the flow is solved.
struct FlowSetup {
  Conditions conditions{};
  Vec3 axis{1, 0, 0};                   ///< of the mean velocity
  std::optional<Real> mean_velocity{};  ///< held exactly in a periodic channel
  int non_orthogonal_correctors = 1;
  flow::Convection convection = flow::Convection::linear;
  /// Force per volume on fluid and solid at x and t; none where empty.
  std::function<Vec3(const Vec3& x, Real t)> body_force{};
};

/// The unknowns at time t.
struct State {
  explicit State(const Mesh& mesh) : u(mesh), p(mesh), phi(mesh) {}
  CellField<Vec3> u;
  CellField<Real> p;
  FaceField<Real> phi;  ///< volume flux, divergence-free to the solver's tolerance
  Real t = 0;
  std::int64_t step = 0;
};

/// What the last step took, and what went wrong in this run.
struct StepReport {
  int velocity_iterations = 0, pressure_iterations = 0;
  Real pressure_residual = 0;
  std::int64_t rejected = 0;                         ///< steps taken back
  std::map<std::string, std::int64_t> rejections{};  ///< by reason, since the start or restart
  bool held_back = false;  ///< the step is smaller than asked for, after a rejected one
  std::string failure;     ///< why the run cannot go on; empty while it can
};

/// Advances a State by the paper's scheme 1. Holds what a step needs so that a step allocates
/// nothing.
class Solver {
 public:
  /// Collective. mesh must outlive the solver.
  Solver(const Mesh& mesh, const Physics& physics, const FlowSetup& setup);

  /// Collective. Sets the velocity at t = 0 and makes its flux divergence-free.
  void start(const std::function<Vec3(const Vec3&)>& u_0);

  /// Collective. Puts a solid of that undeformed shape into the fluid; before the first step.
  /// Errors: Error{input} where it is empty or leaves the mesh.
  void put_solid(const shapes::Shape& shape,
                 KinematicsKind kind = KinematicsKind::log_conformation);

  /// Collective. From t to t + dt. Errors: Error{numerics}; the state is then undefined.
  void step(Real dt);

  /// Collective. A step of dt or, where that fails, of a half, a quarter ... of it from the same
  /// state, with at most eight halvings. A step fails when it throws or when what it leaves behind
  /// is out of bounds (advance.cpp); the steps after it grow by a tenth each. Returns the length
  /// taken; 0 when all failed:
  /// report().failure then says why and the state is that before the step.
  Real advance(Real dt);

  /// Collective. Brings a solid that stands between two steps to the state's time, for fields that
  /// belong together. The next step goes on from there.
  void synchronise();

  /// Adds all that the next step depends on to a checkpoint's list. After the solid is put in.
  void list(io::Snapshot& snapshot);
  /// Collective. Renews what follows from the listed state, once that was read.
  void resume();

  /// Collective. Largest dt with Courant number (dt / 2V) sum |phi| below `courant` in every cell.
  Real advective_dt(Real courant) const;
  /// Collective. Largest dt that moves the solid by a Courant number of one at most: it stands
  /// between two steps and goes on by half of this and half of the last one.
  Real carried_dt() const;
  /// Collective. Largest dt in which nothing that moves at a boundary passes more than `courant` of
  /// the cell beside it: what is known of the flow before the first step.
  Real boundary_dt(Real courant) const;
  /// Collective. The largest step that resolves the solid's elastic waves, or, where these are
  /// treated implicitly, that was found stable; the largest number without a solid.
  Real elastic_dt() const;
  /// Collective. Step in which the solid strains by that much at its last rate, where the
  /// kinematics watches it.
  Real strain_dt(Real strain) const;

  const Mesh& mesh() const { return mesh_; }
  State& state() { return state_; }
  const State& state() const { return state_; }
  /// The solid; empty in a scene without one.
  const std::optional<Body>& body() const { return body_; }
  std::optional<Body>& body() { return body_; }
  const Physics& physics() const { return physics_; }
  StepReport& report() { return report_; }
  const StepReport& report() const { return report_; }
  const Profile& profile() const { return profile_; }
  const BoundaryField<Vec3>& u_b() const { return u_b_; }
  const BoundaryField<Real>& p_b() const { return p_b_; }
  /// What is given at an opening in the middle of the last step, behind its load's answer.
  /// Errors: Error{input} where that patch is none.
  Real opening_pressure(const std::string& patch) const;
  const std::vector<Condition>& conditions() const { return conditions_; }
  /// Velocity gradient at the state's time; collective.
  const CellField<Tensor>& velocity_gradient();
  /// Driving pressure gradient S; zero without a mean velocity.
  Real driving_gradient() const { return forcing_ ? forcing_->gradient : 0; }
  /// Of the mean velocity.
  Vec3 axis() const { return forcing_ ? forcing_->axis() : Vec3{1, 0, 0}; }
  /// Volume mean of the velocity along the axis; collective.
  Real mean_velocity() const { return forcing_ ? forcing_->mean(state_.phi) : 0; }

 private:
  void update_gradients();
  void advance_interface(Real t);
  void advect_pressure_jump();
  void transport_elastic();
  void mix_viscosity();
  void set_elastic_force();
  void add_semi_implicit(Real dt);
  void drive(Real t);
  void predict_momentum(Real dt);
  void predict_flux(Real dt);
  void project(Real dt);
  void hold_mean_velocity(Real dt);
  void check();
  /// Velocity at the boundary at time t; L_ and L_f_ of u and it, where they are needed.
  void set_gradient(BoundaryField<Vec3>& u_b, Real t);
  /// Between cells whose L_ is that of one side of the solid's surface L_f_ is its mean.
  void take_interface_gradient();
  /// L_ = grad u on the listed owned cells; its halo.
  void set_L(const CellField<Vec3>& u, std::span<const Index> cells);
  /// u = the flow's, with what the fluxes tell on the known ones of the listed cells
  /// (solenoidal.hpp); owned and halo.
  void set_velocity_of_fluxes(CellField<Vec3>& u, std::span<const Index> cells);
  /// What may end a step: the equation whose limit is passed, or what was thrown.
  enum class Term {
    none,
    convection,
    pressure,
    transport,
    fraction,
    elasticity,
    strain,
    eigenvalue,
    solve
  };
  struct Rejection {
    std::string reason{};
    Term term = Term::none;
  };
  /// Against what a step of dt leaves behind; empty where there is nothing.
  Rejection rejection_reason(Real dt) const;
  /// Where the state as it stands is worst in that respect: a sentence with figure, place and cell.
  std::string diagnosis(Term term, Real dt);
  std::string diagnosis_of_solid(Term term, Real dt);
  template <class Figure>
  std::string at_worst(const Figure& figure, const char* what, const char* why) const;
  /// What holds a step as short as dt.
  Term holder(Real dt) const;
  /// Counts steps so short that the run will not end; whether there were too many in a row.
  bool stuck(Real dt);
  bool mu_varies() const { return body_ && physics_.mu_s != physics_.mu_f; }
  /// Whether the momentum equation needs the velocity gradient in all cells.
  bool needs_L() const {
    return weights_.uneven || momentum_.reads_L() || mu_varies() ||
           (body_ && body_->interface_gradient);
  }
  /// What the momentum equation takes implicitly besides the viscosity.
  const FaceField<Real>& implicit() const {
    return two_viscosities_ ? two_viscosities_->stiff : kappa_;
  }
  bool stiff() const { return body_ && body_->semi_implicit() && physics_.G > 0; }
  Real elastic_time() const;
  void hold_backup();
  /// Numbers in profile_ of what a step calls.
  struct Calls {
    explicit Calls(Profile& profile);
    int update_gradients, advance_interface, advect_pressure_jump, transport_elastic, mix_viscosity,
        set_elastic_force, add_semi_implicit, drive, predict_momentum, predict_flux, project,
        hold_mean_velocity, check;
  };

  /// What the surface between two viscosities needs.
  struct TwoViscosities {
    TwoViscosities(const Mesh& mesh, const FaceWeights& weights, Real G,
                   const solid::Viscosities& mu)
        : traction(mesh, weights, G, mu), normal(mesh), height(mesh), stiff(mesh) {}
    solid::SurfaceTraction traction;
    CellField<Vec3> normal;  ///< of the surface in a cell, out of the solid
    CellField<Real> height;  ///< of the cell's centre above the surface
    FaceField<Real> stiff;   ///< kappa_ and that of the traction
  };

  const Mesh& mesh_;
  Physics physics_;
  std::vector<Condition> conditions_;
  std::function<Vec3(const Vec3&, Real)> driving_force_;
  FaceWeights weights_;
  State state_;
  BoundaryField<Vec3> u_b_, u_b_new_;
  BoundaryField<Real> p_b_;
  BoundaryField<Real> q_b_;
  CellField<Vec3> grad_p_, grad_q_, force_;
  CellField<Tensor> L_;
  CellField<Real> q_, divergence_;
  FaceField<Real> mu_, kappa_, rhie_chow_source_;
  GradientStencil u_stencil_;
  VertexMean<Tensor> vertex_mean_;
  std::vector<Tensor> L_f_;                              // at irregular faces
  std::vector<std::pair<Index, Tensor>> interface_L_f_;  // what stands there beside the surface
  flow::Openings openings_;
  flow::Projection projection_;
  flow::Loads loads_;
  flow::Momentum momentum_;
  std::optional<flow::Forcing> forcing_;
  std::optional<Body> body_;
  std::optional<solid::BodyForce> body_force_;     // where there is one
  std::optional<TwoViscosities> two_viscosities_;  // where they differ
  bool leaves_ = false;                            // whether a solid may leave the mesh
  std::optional<Backup> backup_;
  Real solid_dt_ = 0;                               // length of the solid's step
  Real dt_cap_ = std::numeric_limits<Real>::max();  // after a rejected step
  Real dt_largest_ = 0;                             // of this run
  int tiny_steps_ = 0;                              // in a row
  Real cells_norm_ = 0;                             // sqrt(sum V^2)
  StepReport report_;
  Profile profile_;
  Calls calls_;
};

}  // namespace fsi
