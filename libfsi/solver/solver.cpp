#include "libfsi/solver/solver.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/pressure_jump.hpp"
#include "libfsi/solid/solenoidal.hpp"
#include "libfsi/vof/motion.hpp"

namespace fsi {
namespace {

/// A constant matrix of a small 2-D mesh is factored once; all others get multigrid.
Method pressure_method(const Mesh& mesh) {
  constexpr GlobalIndex small = 100'000;
  return mesh.dim == 2 && mesh.n_global <= small ? Method::direct : Method::multigrid;
}

std::vector<bool> velocity_given(const std::vector<Condition>& conditions) {
  std::vector<bool> given;
  for (const Condition& condition : conditions) given.push_back(!fixes_pressure(condition));
  return given;
}

}  // namespace

Solver::Solver(const Mesh& mesh, const Physics& physics, const FlowSetup& setup)
    : mesh_(mesh),
      physics_(physics),
      conditions_(resolve(setup.conditions, mesh)),
      driving_force_(setup.body_force),
      weights_(mesh),
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
      rhie_chow_source_(mesh),
      u_stencil_(mesh, weights_, velocity_given(conditions_)),
      vertex_mean_(mesh, u_stencil_),
      L_f_(weights_.irregular.size()),
      openings_(mesh, conditions_, physics.rho),
      projection_(mesh, weights_, conditions_, pressure_method(mesh),
                  setup.non_orthogonal_correctors),
      loads_(mesh, projection_, openings_, physics.rho),
      momentum_(mesh, weights_, conditions_, physics.rho, physics.mu_f, setup.convection),
      calls_(profile_) {
  for (const Condition& condition : conditions_)
    leaves_ = leaves_ || fixes_pressure(condition) || prescribes_flow(condition);
  if (setup.mean_velocity) forcing_.emplace(mesh, projection_, setup.axis, *setup.mean_velocity);
  // The transposed viscous term is explicit: backward Euler where it is large.
  if (physics.mu_s > 2 * physics.mu_f || physics.mu_f > 2 * physics.mu_s) momentum_.theta = 1;
  Sum squares;
  for (Index c = 0; c < mesh.n_owned; ++c) squares.add(mesh.V[c] * mesh.V[c]);
  cells_norm_ = std::sqrt(squares.total());
}

void Solver::start(const std::function<Vec3(const Vec3&)>& u_0) {
  for (Index c = 0; c < mesh_.n_cells; ++c) state_.u[c] = u_0(mesh_.C[c]);
  set_gradient(u_b_, state_.t);
  openings_.set_pressure(p_b_, state_.u);
  const flow::FluxTerms terms{.L_f = L_f_,
                              .p = state_.p,
                              .grad_p = grad_p_,
                              .grad_p_f = projection_.face_gradient(),
                              .p_b = p_b_,
                              .rhie_chow_source = rhie_chow_source_,
                              .mu = mu_,
                              .theta = momentum_.theta_taken(),
                              .kappa = kappa_,
                              .elastic = kappa_,
                              .rho = physics_.rho};
  flow::predict_flux(state_.phi, state_.u, u_b_, momentum_.boundary().open, terms, weights_, mesh_);
  projection_.project(state_.phi, q_, grad_q_, q_b_, 1e-12 * mesh_.total_volume);
  for (Index c = 0; c < mesh_.n_cells; ++c) state_.u[c] -= grad_q_[c];
  if (forcing_) {
    forcing_->hold(state_.u, state_.phi, physics_.rho, 1);
    forcing_->gradient = 0;
  }
  hold_backup();
}

void Solver::put_solid(const shapes::Shape& shape, KinematicsKind kind) {
  std::vector<Patch> mirrors;
  for (std::size_t i = 0; i < conditions_.size(); ++i)
    if (std::holds_alternative<Slip>(conditions_[i])) mirrors.push_back(mesh_.patches[i]);
  body_.emplace(mesh_, weights_, shape, physics_.G, kind, mirrors, physics_.law);
  body_->t = state_.t;
  if (physics_.solid_acceleration != Vec3{})
    body_force_.emplace(mesh_, weights_, physics_.rho * physics_.solid_acceleration);
  require(body_->filled.volume > 0,
          "the solid is empty: its shape lies outside the mesh or is smaller than a cell");
  const Real touching = 1e-9 * std::pow(mesh_.total_volume, 1.0 / mesh_.dim);
  require(body_->filled.clearance > -touching, "the solid sticks out of the mesh by " +
                                                   std::to_string(-body_->filled.clearance) +
                                                   ": move it or make it smaller");
  if (mu_varies()) {
    momentum_.bound_explicit_viscosity(std::max(physics_.mu_s, physics_.mu_f));
    if (body_->extended() && physics_.mu_s <= solid::SurfaceTraction::ratio_max * physics_.mu_f)
      two_viscosities_.emplace(mesh_, weights_, physics_.G,
                               solid::Viscosities{physics_.mu_s, physics_.mu_f});
    if (two_viscosities_) momentum_.hold_old();
  }
  mix_viscosity();
  hold_backup();
}

void Solver::step(Real dt) {
  if (body_) {
    advance_interface(state_.t + body_->time_offset() * dt);  // d alpha/dt + div(alpha u) = 0
                                                              //            [Matsumiya25] (5)
    advect_pressure_jump();  // p^n's jump goes with it                     pressure_jump.hpp
  }
  update_gradients();  // grad p^n, L^n
  if (body_) {
    transport_elastic();    // d psi/dt + div(u psi) = ...              [Fattal04] (19)
                            // or dBt/dt + div(u Bt) = ...              [Matsumiya25] (10)
                            // or d xi/dt + u . grad xi = 0             [Kamrin12]
    mix_viscosity();        // mu = alpha mu_s + (1 - alpha) mu_f       [Matsumiya25] (3)
    set_elastic_force();    // f = div(alpha G dev T)                   [Matsumiya25] (11)
    add_semi_implicit(dt);  // + div(kappa grad (u* - u^n)) + ...       semi_implicit.hpp
  }
  drive(state_.t + dt / 2);  // f += f(x, t)
  predict_momentum(dt);      // du/dt + div(u u) = ...                  [Matsumiya25] (12)
  predict_flux(dt);          // phi* from u*                            [Rhie83]
  project(dt);               // div u = 0                               [Matsumiya25] (1)
  hold_mean_velocity(dt);    // S                                       [Matsumiya25] (12)
  check();
  state_.t += dt;
  ++state_.step;
}

void Solver::update_gradients() {
  const Profile::Call call(profile_, calls_.update_gradients);
  openings_.set_pressure(p_b_, state_.u);
  projection_.set_gradient(grad_p_, state_.p, p_b_);
  set_gradient(u_b_, state_.t);
  openings_.set_inflow(u_b_, state_.phi);
}

void Solver::set_gradient(BoundaryField<Vec3>& u_b, Real t) {
  set_boundary_velocity(u_b, state_.u, conditions_, t, mesh_);
  if (!needs_L()) return;
  gradient(L_, state_.u, u_b, u_stencil_, mesh_);
  vertex_mean_.set(L_f_, L_);
  openings_.set_velocity(u_b, state_.u, L_f_, weights_);
}

void Solver::take_interface_gradient() {
  interface_L_f_.clear();
  if (!body_ || !body_->interface_gradient) return;
  const Band& strain_cells = body_->strained_cells();
  const CellField<Real>& listed = strain_cells.listed();
  for (const Index f : strain_cells.faces()) {
    const Index i = weights_.place[f], P = mesh_.owner[f];
    if (i < 0) continue;
    const Index N = f < mesh_.n_internal ? mesh_.neighbour[f] : P;
    if (listed[P] == 0 || listed[N] == 0) continue;
    const Real lambda = f < mesh_.n_internal ? weights_.lambda[f] : 0;
    L_f_[i] = (1 - lambda) * L_[P] + lambda * L_[N];
    interface_L_f_.emplace_back(i, L_f_[i]);
  }
}

void Solver::advance_interface(Real t) {
  const Profile::Call call(profile_, calls_.advance_interface);
  solid_dt_ = t - body_->t;
  body_->t = t;
  body_->alpha_mid.assign(body_->alpha);
  // A flux follows the plane of one cell, for a part of the step in which the surface stays in it:
  // in whole steps the way of a thin curved body depends on dt (doc/theory/interface.md).
  constexpr Real courant = 0.2, parts_max = 10;
  const Real longest = vof::interface_dt(body_->alpha, state_.phi, courant, mesh_);
  const int parts =
      static_cast<int>(std::clamp(std::ceil(solid_dt_ / longest), Real{1}, parts_max));
  body_->advected = {};
  for (int i = 0; i < parts; ++i) {
    body_->advected.add(vof::advect(body_->alpha, body_->interface, state_.phi, state_.u,
                                    solid_dt_ / parts, mesh_, body_->advect_scratch));
    if (leaves_) body_->count_out();
    vof::reconstruct(body_->interface, body_->alpha, mesh_, body_->reconstruct_scratch);
  }
  for (Index c = 0; c < mesh_.n_cells; ++c)
    body_->alpha_mid[c] = (body_->alpha_mid[c] + body_->alpha[c]) / 2;
}

void Solver::advect_pressure_jump() {
  const Profile::Call call(profile_, calls_.advect_pressure_jump);
  if (!body_->advects_pressure_jump()) return;
  solid::advect_pressure_jump(state_.p, body_->alpha_mid, body_->alpha, body_->T(), physics_.G,
                              mesh_, body_->band.cells());
  mesh_.halo.update(state_.p);
}

void Solver::set_L(const CellField<Vec3>& u, std::span<const Index> cells) {
  gradient(L_, u, u_b_, u_stencil_, mesh_, cells);
  mesh_.halo.update(L_);
}

void Solver::set_velocity_of_fluxes(CellField<Vec3>& u, std::span<const Index> cells) {
  const solid::FlowSnapshot snapshot{state_.phi, state_.u, L_, projection_.stencil().cells,
                                     weights_};
  u.assign(state_.u);
  for (const Index c : cells)
    if (body_->alpha_mid[c] >= solid::alpha_known)
      u[c] = solid::velocity_of_fluxes(snapshot, body_->alpha_mid, mesh_, c);
  mesh_.halo.update(u);
}

void Solver::transport_elastic() {
  const Profile::Call call(profile_, calls_.transport_elastic);
  const bool interface_gradient = body_->interface_gradient.has_value(),
             by_flux = body_->strain_by_flux();
  const CellField<Vec3>& u = by_flux ? grad_q_ : state_.u;  // grad_q: scratch here
  const solid::Contact contact{u_b_, body_->touched};
  const solid::FlowSnapshot snapshot{
      state_.phi,
      u,
      L_,
      projection_.stencil().cells,
      weights_,
      interface_gradient ? &body_->interface_gradient->strain() : nullptr,
      &contact,
      std::sqrt(physics_.G / physics_.rho),
      physics_.G / physics_.mu_s};
  std::visit(
      [&](auto& k) {
        k.mark(body_->strain_fraction());
        if (by_flux) body_->set_touched(k.strain_cells(), momentum_.boundary().open);
        if (by_flux) set_velocity_of_fluxes(grad_q_, k.strain_cells());
        if (by_flux || !needs_L()) set_L(u, k.strain_cells());
        if (interface_gradient) {
          body_->kink_profile->set(body_->interface, weights_);
          body_->interface_gradient->apply(
              L_, state_.u, u_b_,
              {body_->alpha, body_->kink_profile->normal, body_->kink_profile->solid_side,
               body_->kink_profile->fluid_side},
              k.strain_cells());
          body_->interface_gradient->set_strain(L_, state_.u, u_b_, body_->alpha, k.strain_cells());
        }
        body_->strain = k.transport(body_->strain_fraction(), snapshot, solid_dt_, body_->grad);
        if (by_flux && needs_L()) set_L(state_.u, k.strain_cells());
      },
      body_->kinematics);
  body_->update_B();
  take_interface_gradient();
}

void Solver::mix_viscosity() {
  const Profile::Call call(profile_, calls_.mix_viscosity);
  if (!mu_varies()) return;
  flow::mixture_viscosity(mu_, body_->alpha, physics_.mu_f, physics_.mu_s, weights_, mesh_);
}

void Solver::add_semi_implicit(Real dt) {
  const Profile::Call call(profile_, calls_.add_semi_implicit);
  if (!body_->semi_implicit()) return;
  if (!needs_L()) {
    gradient(L_, state_.u, u_b_, u_stencil_, mesh_, body_->band.cells());
    mesh_.halo.update(L_, body_->band.listed());
  }
  // A map is less accurate with less damping where the surface lies in mid-cell.
  const bool map = std::holds_alternative<solid::ReferenceMap>(body_->kinematics);
  const solid::ElasticTerms solid{body_->lambda,
                                  body_->alpha_f,
                                  state_.u,
                                  L_,
                                  body_->alpha,
                                  physics_.G,
                                  physics_.rho,
                                  map ? 0 : physics_.mu_s,
                                  dt,
                                  !map,
                                  body_->interface_gradient.has_value(),
                                  two_viscosities_ ? &two_viscosities_->normal : nullptr};
  body_->semi_implicit_elasticity.apply(kappa_, force_, solid, weights_, body_->band);
  if (!two_viscosities_) return;
  two_viscosities_->stiff.assign(kappa_);
  two_viscosities_->traction.add_semi_implicit(two_viscosities_->stiff, body_->alpha_f,
                                               body_->band);
}

void Solver::set_elastic_force() {
  const Profile::Call call(profile_, calls_.set_elastic_force);
  force_.fill({});
  rhie_chow_source_.fill(0);
  const solid::ElasticState strain_cells{body_->T(), body_->alpha,
                                         body_->extended() ? &body_->alpha_f : nullptr,
                                         &body_->normal_f, &body_->mirror};
  body_->elastic_force.apply(force_, rhie_chow_source_, strain_cells, weights_,
                             projection_.stencil(), body_->band, body_->grad);
  if (two_viscosities_) {
    vof::cell_plane(two_viscosities_->normal, two_viscosities_->height, body_->alpha,
                    body_->interface, mesh_, body_->band.cells());
    mesh_.halo.update(two_viscosities_->normal, body_->band.listed());
    two_viscosities_->traction.apply(
        force_, rhie_chow_source_,
        {state_.u, L_, L_f_, body_->T(), body_->alpha, body_->alpha_f, body_->normal_f,
         two_viscosities_->normal, two_viscosities_->height, mu_},
        weights_, projection_.stencil(), body_->band);
  }
  if (body_force_)
    body_force_->apply(force_, rhie_chow_source_, body_->alpha_f, projection_.stencil(),
                       body_->band);
}

void Solver::drive(Real t) {
  const Profile::Call call(profile_, calls_.drive);
  if (!driving_force_) return;
  if (!body_) force_.fill({});
  for (Index c = 0; c < mesh_.n_owned; ++c) force_[c] += driving_force_(mesh_.C[c], t);
}

void Solver::predict_momentum(Real dt) {
  const Profile::Call call(profile_, calls_.predict_momentum);
  set_boundary_velocity(u_b_new_, state_.u, conditions_, state_.t + dt, mesh_);
  if (auto& old = momentum_.old())
    set_boundary_velocity(old->u_b, old->u, conditions_, state_.t - momentum_.dt_old, mesh_);
  const flow::MomentumTerms terms{
      .u_b = u_b_,
      .u_b_new = u_b_new_,
      .grad_p = grad_p_,
      .L = L_,
      .L_f = L_f_,
      .phi = state_.phi,
      .mu = mu_,
      .kappa = implicit(),
      .mu_varies = mu_varies(),
      .stiff = stiff(),
      .force = force_,
      .body = forcing_ ? forcing_->gradient * forcing_->axis() : Vec3{}};
  report_.velocity_iterations = momentum_.predict(state_.u, terms, dt);
}

void Solver::predict_flux(Real dt) {
  const Profile::Call call(profile_, calls_.predict_flux);
  set_gradient(u_b_new_, state_.t + dt);
  for (const auto& [i, L] : interface_L_f_) L_f_[i] = L;
  const flow::FluxTerms terms{
      .L_f = L_f_,
      .p = state_.p,
      .grad_p = grad_p_,
      .grad_p_f = projection_.face_gradient(),
      .p_b = p_b_,
      .rhie_chow_source = rhie_chow_source_,
      .mu = mu_,
      .theta = momentum_.theta_taken(),
      .kappa = implicit(),
      .elastic = kappa_,
      .rho = physics_.rho,
      .dt = dt,
      .stress = body_ ? physics_.G : 0,
      .flux_strain = body_ && body_->strain_by_flux()
                         ? 1 / solid::SemiImplicitElasticity::implicit_fraction
                         : 0};
  flow::predict_flux(state_.phi, state_.u, u_b_new_, momentum_.boundary().open, terms, weights_,
                     mesh_);
}

void Solver::project(Real dt) {
  const Profile::Call call(profile_, calls_.project);
  flow::divergence(divergence_, state_.phi, mesh_);
  constexpr Real volume_change = 1e-10;  // of a cell in a step, that the tolerance may leave
  openings_.advance(q_b_, state_.t + dt / 2, dt / physics_.rho);
  const SolveResult solve =
      projection_.project(state_.phi, q_, grad_q_, q_b_, volume_change * cells_norm_ / dt);
  loads_.answer(state_.phi, q_, grad_q_, state_.t + dt / 2, dt);
  for (Index c = 0; c < mesh_.n_cells; ++c) {
    state_.u[c] -= grad_q_[c];
    state_.p[c] += physics_.rho / dt * q_[c];
  }
  flow::add_viscous_pressure(state_.p, divergence_, mu_, kappa_, momentum_.theta_taken(), weights_,
                             mesh_);
  report_.pressure_iterations = solve.iterations;
  report_.pressure_residual = solve.residual;
}

void Solver::hold_mean_velocity(Real dt) {
  const Profile::Call call(profile_, calls_.hold_mean_velocity);
  if (forcing_) forcing_->hold(state_.u, state_.phi, physics_.rho, dt);
}

}  // namespace fsi
