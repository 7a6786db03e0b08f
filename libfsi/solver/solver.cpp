#include "libfsi/solver/solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"

namespace fsi {
namespace {

/// A constant matrix of a small 2-D mesh is factored once; all others get multigrid.
Method pressure_method(const Mesh& mesh) {
  constexpr GlobalIndex small = 100'000;
  return mesh.dim == 2 && mesh.n_global <= small ? Method::direct : Method::multigrid;
}

/// The planes about which the pressure is symmetric. A force of the driver may point through them.
std::vector<bool> mirrors_of(const std::vector<Condition>& conditions, bool driven,
                             const Mesh& mesh) {
  constexpr Real flat = 0.1;  // degrees
  std::vector<bool> mirrors = patches_where(conditions, lets_slip);
  for (std::size_t i = 0; i < mirrors.size(); ++i)
    mirrors[i] = mirrors[i] && !driven && curvature(mesh.patches[i], mesh) <= flat;
  return mirrors;
}

/// Velocities of the boundary without a pace of their own, and the force.
std::vector<OfPlaceAndTime> over_time(const std::vector<Condition>& conditions,
                                      const OfPlaceAndTime::Function& force, const Mesh& mesh) {
  std::vector<OfPlaceAndTime> given;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const auto* fixed = std::get_if<FixedVelocity>(&conditions[i]);
    const Patch& patch = mesh.patches[i];
    if (fixed != nullptr && !fixed->pace.any())
      given.emplace_back(fixed->u,
                         std::span(mesh.Cf).subspan(patch.begin, patch.end - patch.begin));
  }
  if (force) given.emplace_back(force, std::span(mesh.C).first(mesh.n_owned));
  return given;
}

/// Errors: Error{input} where what moves the fluid points out of a mesh of two dimensions.
void require_in_plane(const Physics& physics, const OfPlaceAndTime::Function& force,
                      const Mesh& mesh) {
  if (mesh.dim == 3) return;
  Real z = 0;
  for (Index c = 0; force && c < mesh.n_owned; ++c)
    z = std::max(z, std::abs(force(mesh.C[c], 0).z));
  z = global_max(z);
  const auto along_z = [](const char* name, Real value) {
    return std::string(name) + print(" has the component %g along z", value) +
           ", but a mesh of two dimensions lies in the x-y plane, and nothing moves out of it";
  };
  require(physics.gravity.z == 0, along_z("gravity", physics.gravity.z));
  require(z == 0, along_z("the body force", z));
}

/// Collective. Errors: Error{input} where the velocity to start from is not finite.
void require_finite(const CellField<Vec3>& u_0, const Mesh& mesh) {
  Index first = 0;
  while (first < mesh.n_owned && std::isfinite(norm2(u_0[first]))) ++first;
  const bool finite = first == mesh.n_owned;
  const Vec3 x = finite ? Vec3{} : mesh.C[first];
  const std::vector<Real> all = gathered(std::array{finite ? 0.0 : 1.0, x.x, x.y, x.z});
  for (std::size_t i = 0; i < all.size(); i += 4)
    require(all[i] == 0, print("the velocity to start from is not finite at (%.5g, %.5g, %.5g)",
                               all[i + 1], all[i + 2], all[i + 3]));
}

}  // namespace

Solver::Solver(const Mesh& mesh, const Physics& physics, const FlowSetup& setup)
    : mesh_(mesh),
      physics_(physics),
      conditions_(resolve(setup.conditions, mesh)),
      axis_(setup.axis / norm(setup.axis)),
      driving_force_(setup.body_force),
      over_time_(over_time(conditions_, driving_force_, mesh)),
      weights_(mesh),
      courant_(mesh, setup.convection),
      state_(mesh),
      u_b_(mesh),
      u_b_new_(mesh),
      p_b_(mesh),
      q_b_(mesh),
      grad_p_(mesh),
      grad_q_(mesh),
      force_(mesh),
      L_(mesh),
      q_(mesh),
      divergence_(mesh),
      mu_(mesh, physics.mu_f),
      kappa_(mesh),
      stiffness_(mesh),
      rhie_chow_source_(mesh),
      excess_(mesh),
      u_stencil_(mesh, weights_,
                 patches_where(conditions_, [](const Condition& c) { return !fixes_pressure(c); }),
                 patches_where(conditions_, lets_slip)),
      vertex_mean_(mesh, u_stencil_),
      L_f_(weights_.irregular.size()),
      openings_(mesh, conditions_, physics.rho),
      projection_(mesh, weights_, conditions_, pressure_method(mesh),
                  setup.non_orthogonal_correctors,
                  mirrors_of(conditions_, static_cast<bool>(driving_force_), mesh)),
      loads_(mesh, projection_, openings_, physics.rho),
      viscous_pressure_(mesh, weights_, faces_where(conditions_, mesh, lets_slip)),
      bulk_friction_(mesh, projection_, openings_),
      wall_parabola_(mesh, conditions_, u_stencil_),
      momentum_(mesh, weights_, conditions_, physics.rho, physics.mu_f, setup.convection),
      calls_{profile_} {
  require_in_plane(physics, driving_force_, mesh);
  for (const Condition& condition : conditions_)
    leaves_ = leaves_ || fixes_pressure(condition) || prescribes_flow(condition);
  prescribed_ = leaves_ && std::ranges::none_of(conditions_, fixes_pressure);
  // What keeps kinetic energy has all of convection explicit, in steps as short as that asks for.
  if (courant_.any_simplex() && !setup.orthogonal_projection)
    stiff_.emplace(mesh), modes_.stiff = modes_.implicit_convection = true;
  if (setup.orthogonal_projection) make_orthogonal();
  if (driving_force_ && !setup.orthogonal_projection) at_rest_.emplace(AtRest{mesh_});
  if (wall_parabola_.any()) {  // its excess is explicit
    momentum_.bound_explicit_viscosity(physics.mu_f, flow::WallParabola::theta_max);
    momentum_.hold_old_of_part();
  }
  if (setup.mean_velocity) forcing_.emplace(mesh, projection_, axis_, *setup.mean_velocity);
  if (leaves_ || forcing_)
    friction_ = flow::bulk_friction(mesh, weights_, conditions_, pressure_method(mesh));
  Sum squares;
  for (Index c = 0; c < mesh.n_owned; ++c) squares.add(mesh.V[c] * mesh.V[c]);
  cells_norm_ = std::sqrt(squares.total());
}

void Solver::make_orthogonal() {
  const bool open = std::ranges::any_of(conditions_, fixes_pressure);
  require(!open,
          "an orthogonal projection (-flow_projection) takes no patch where the pressure is given");
  projection_.make_orthogonal(u_stencil_, conditions_);
}

void Solver::start(const std::function<Vec3(const Vec3&)>& u_0) {
  for (Index c = 0; c < mesh_.n_cells; ++c) state_.u[c] = u_0(mesh_.C[c]);
  require_finite(state_.u, mesh_);
  set_gradient(L_, u_b_, state_.t);
  if (projection_.orthogonal()) flow::face_means(L_f_, L_, weights_, mesh_);
  openings_.set_pressure(p_b_, state_.u);
  flow::predict_flux(state_.phi, state_.u, u_b_, momentum_.boundary().open, flux_terms(0), weights_,
                     mesh_);
  projection_.project(state_.phi, q_, grad_q_, q_b_, 1e-12 * flow::size(state_.phi, mesh_));
  for (Index c = 0; c < mesh_.n_cells; ++c) state_.u[c] -= grad_q_[c];
  if (forcing_) {
    forcing_->hold(state_.u, state_.phi, physics_.rho, 0, 1);
    forcing_->gradient = 0;
  }
  set_pressure_of_rest();
  add_pressure_of_body_force();
  start_rate_ = acceleration_rate();
  hold_backup();
}

void Solver::step(Real dt) {
  require_step(dt);
  const Real t = state_.t;
  for (Body& body : bodies_) hold_shape(body);                                      // (1)
  for (Body& body : bodies_) advance_interface(body, t + body.time_offset() * dt);  // (2)
  separate_bodies();                                                                // (3)
  for (const Body& body : bodies_) advect_pressure_jump(state_.p, body);            // (4)
  set_pressure_gradient(grad_p_, state_);                                           // (5)
  set_velocity_gradient(L_, state_);                                                // (6)
  clear_forces();
  for (Body& body : bodies_) transport_memory(body, L_);       // (7)
  transport_elastic(L_);                                       // (8)
  mix_viscosity(mu_);                                          // (9)
  mix_density();                                               // (10)
  for (Body& body : bodies_) add_elastic_force(force_, body);  // (11)
  add_semi_implicit(kappa_, stiffness_, force_, dt);           // (12)
  add_body_force(force_, t + dt / 2);                          // (13)
  balance_weight(state_);                                      // (14)
  set_flux_excess(state_, dt);                                 // (15)
  predict_momentum(state_.u, dt);                              // (16)
  predict_flux(state_.phi, state_.u, dt);                      // (17)
  project(state_, dt);                                         // (18)
  hold_mean_velocity(state_, dt);                              // (19)
  check(state_);
  state_.t += dt;
  ++state_.step;
}

void Solver::set_pressure_gradient(CellField<Vec3>& grad_p, const State& state) {
  const Profile::Call call(profile_, calls_.set_pressure_gradient);
  openings_.set_pressure(p_b_, state.u);
  projection_.set_gradient(grad_p, state.p, p_b_);
}

void Solver::set_velocity_gradient(CellField<Tensor>& L, const State& state) {
  const Profile::Call call(profile_, calls_.set_velocity_gradient);
  set_gradient(L, u_b_, state.t);
  openings_.set_inflow(u_b_, state.phi);
}

void Solver::set_gradient(CellField<Tensor>& L, BoundaryField<Vec3>& u_b, Real t) {
  set_boundary_velocity(u_b, state_.u, conditions_, t, mesh_);
  if (!needs_L()) return;
  gradient(L, state_.u, u_b, u_stencil_, mesh_);
  vertex_mean_.set(L_f_, L);
  openings_.set_velocity(u_b, state_.u, L_f_, weights_);
}

void Solver::add_body_force(CellField<Vec3>& force, Real t) {
  const Profile::Call call(profile_, calls_.add_body_force);
  if (!driving_force_) return;
  Real sum = 0;
  for (Index c = 0; c < mesh_.n_owned; ++c) {
    const Vec3 f = driving_force_(mesh_.C[c], t);
    force[c] += f;
    sum += std::abs(f.x) + std::abs(f.y) + std::abs(f.z);
  }
  if (!all_of_ranks(std::isfinite(sum)))
    throw Error(ErrorKind::numerics, "the body force is not finite");
}

void Solver::set_flux_excess(const State& state, Real dt) {
  const Profile::Call call(profile_, calls_.set_flux_excess);
  if (projection_.orthogonal()) return;
  flow::set_flux_excess(excess_, state.phi, state.u, L_f_, weights_, mesh_);
  openings_.set_flux_excess(excess_, state.phi, state.u, L_f_, weights_);
  const Real old = momentum_.dt_old;
  projection_.subtract_oblique_rest(excess_, dt < old ? dt / old : 1);
}

void Solver::predict_momentum(CellField<Vec3>& u, Real dt) {
  const Profile::Call call(profile_, calls_.predict_momentum);
  set_boundary_velocity(u_b_new_, u, conditions_, state_.t + dt, mesh_);
  if (auto& old = momentum_.old())
    set_boundary_velocity(old->u_b, old->u, conditions_, state_.t - momentum_.dt_old, mesh_);
  kinks_.clear();
  for (const Body& body : bodies_) add_kinks(kinks_, body, L_, physics_.mu_f);
  const flow::MomentumTerms terms{.u_b = u_b_,
                                  .u_b_new = u_b_new_,
                                  .grad_p = grad_p_,
                                  .L = L_,
                                  .L_f = L_f_,
                                  .phi = state_.phi,
                                  .mu = mu_,
                                  .kappa = implicit(),
                                  .mu_varies = modes_.mu_varies,
                                  .stiff = modes_.stiff,
                                  .force = force_,
                                  .rho = heavy_ ? &heavy_->density.inertia() : nullptr,
                                  .acceleration = heavy_ ? &heavy_->acceleration : nullptr,
                                  .body = driving_gradient() * axis_,
                                  .explicit_courant = explicit_courant(),
                                  .one_sided = interface_faces_,
                                  .kinks = &kinks_,
                                  .parabola = wall_parabola_.any() ? &wall_parabola_ : nullptr};
  report_.velocity_iterations = momentum_.predict(u, terms, dt);
}

flow::FluxTerms Solver::flux_terms(Real dt) const {
  return {.L_f = L_f_,
          .p = state_.p,
          .grad_p = grad_p_,
          .grad_p_f = projection_.face_gradient(),
          .p_b = p_b_,
          .rhie_chow_source = rhie_chow_source_,
          .mu = mu_,
          .theta = momentum_.theta_taken(),
          .kappa = implicit(),
          .rho = physics_.rho,
          .dt = dt,
          .dt_old = momentum_.dt_before,
          .density = heavy_ ? &heavy_->density : nullptr,
          .acceleration = heavy_ ? &heavy_->acceleration : nullptr,
          .stress = modes_.G,
          .stiffness = bodies_.empty() ? nullptr : &stiffness_,
          .excess = dt > 0 ? &excess_ : nullptr,
          .t = state_.t};
}

void Solver::predict_flux(FaceField<Real>& phi, const CellField<Vec3>& u, Real dt) {
  const Profile::Call call(profile_, calls_.predict_flux);
  set_gradient(L_, u_b_new_, state_.t + dt);
  if (projection_.orthogonal()) flow::face_means(L_f_, L_, weights_, mesh_);
  for (std::size_t i = 0; i < interface_faces_.size(); ++i)
    L_f_[weights_.place[interface_faces_[i]]] = interface_L_f_[i];
  const flow::FluxTerms terms = flux_terms(projection_.orthogonal() ? 0 : dt);  // 0: of u* alone
  flow::predict_flux(phi, u, u_b_new_, momentum_.boundary().open, terms, weights_, mesh_);
}

void Solver::project(State& state, Real dt) {
  const Profile::Call call(profile_, calls_.project);
  flow::divergence(divergence_, state.phi, mesh_);
  // What the tolerance may leave, of a cell in a step. It leaves an error of rho L^2 / dt^2 times
  // this in p, so it falls with the Courant number where steps are short.
  constexpr Real volume_change = 1e-10, least = 1e-4;
  const Real part = std::clamp(4 * momentum_.courant() * momentum_.courant(), least, Real{1});
  renew_responses();
  bulk_friction_.begin();
  openings_.advance(q_b_, state.t + dt / 2, dt / physics_.rho);
  const SolveResult solve =
      projection_.project(state.phi, q_, grad_q_, q_b_, part * volume_change * cells_norm_ / dt);
  loads_.answer(state.phi, q_, grad_q_, state.t + dt / 2, dt, flow::reach(dt, momentum_.dt_before));
  if (modes_.implicit_convection) courant_.share(grad_q_, *stiff_, dt / physics_.rho, weights_);
  for (Index c = 0; c < mesh_.n_cells; ++c) {
    state.u[c] -= grad_q_[c];
    state.p[c] += physics_.rho / dt * q_[c];
  }
  bulk_friction_.add(state.p, q_, friction(), dt / physics_.rho);
  if (!projection_.orthogonal())
    viscous_pressure_.add(state.p, divergence_, mu_, kappa_, momentum_.theta_taken());
  openings_.set_pressure(p_b_, state.u);  // of this step, as p is: the balance of energy takes both
  report_.pressure_iterations = solve.iterations;
  report_.pressure_residual = solve.residual;
}

Real Solver::friction() const {
  // With a density of its own the openings' shares would be those of each step.
  if (heavy_ && openings_.all().size() > 1) return 0;
  Real mu = physics_.mu_f, rho = physics_.rho;
  for (const Body& body : bodies_) mu = std::min(mu, body.mu), rho = std::max(rho, body.rho);
  return physics_.rho / rho * mu * friction_;
}

void Solver::hold_mean_velocity(State& state, Real dt) {
  const Profile::Call call(profile_, calls_.hold_mean_velocity);
  if (!forcing_) return;
  const Real change = forcing_->hold(state.u, state.phi, physics_.rho, friction(), dt);
  forcing_->add_pressure(state.p, change);
}

}  // namespace fsi
