// What a step does with the solids: how they are put in, carried, strained, and push.

#include <algorithm>
#include <cmath>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/pressure_jump.hpp"
#include "libfsi/solid/solenoidal.hpp"
#include "libfsi/solver/solver.hpp"
#include "libfsi/vof/motion.hpp"

namespace fsi {
namespace {

/// Errors: Error{input} where the body cannot be that one among the others.
void require_place(const Body& body, const std::deque<Body>& others, const Mesh& mesh) {
  const std::string which = body.name.empty() ? "the solid" : "solid \"" + body.name + "\"";
  require(body.filled.volume > 0,
          which + " is empty: its shape lies outside the mesh or is smaller than a cell");
  const Real touching = 1e-9 * std::pow(mesh.total_volume, 1.0 / mesh.dim);
  require(body.filled.clearance > -touching, which + " sticks out of the mesh by " +
                                                 std::to_string(-body.filled.clearance) +
                                                 ": move it or make it smaller");
  for (const Body& other : others) {
    if (&other == &body) continue;
    require(other.name != body.name, "two solids have the name \"" + body.name + "\"");
    Real most = 0;
    for (Index c = 0; c < mesh.n_owned; ++c)
      if (body.alpha[c] > 0 && other.alpha[c] > 0)
        most = std::max(most, body.alpha[c] + other.alpha[c] - 1);
    constexpr Real error_of_fill = 1e-3;
    require(global_max(most) < error_of_fill,
            which + " overlaps solid \"" + other.name + "\" at the start: move one of them");
  }
}

}  // namespace

void Solver::put_solid(const shapes::Shape& shape, KinematicsKind kind) {
  put_solid({.shape = shape,
             .G = physics_.G,
             .mu = physics_.mu_s,
             .kinematics = kind,
             .acceleration = physics_.solid_acceleration,
             .law = physics_.law});
}

void Solver::put_solid(const Solid& solid) {
  std::vector<Patch> mirrors;
  for (std::size_t i = 0; i < conditions_.size(); ++i)
    if (std::holds_alternative<Slip>(conditions_[i])) mirrors.push_back(mesh_.patches[i]);
  bodies_.emplace_back(mesh_, weights_, solid, physics_, mirrors);
  Body& body = bodies_.back();
  body.t = state_.t;
  require_place(body, bodies_, mesh_);
  modes_.stiff = modes_.stiff || (body.semi_implicit() && body.G > 0);
  modes_.flux_strain = modes_.flux_strain || body.strain_by_flux();
  modes_.one_sided = modes_.one_sided || body.interface_gradient;
  modes_.G = std::max(modes_.G, body.G);
  if (body.strain_by_flux() && !by_flux_) by_flux_.emplace(mesh_);
  if (body.mu != physics_.mu_f) {
    modes_.mu_varies = true;
    // The transposed viscous term is explicit: backward Euler where it is large.
    if (body.mu > 2 * physics_.mu_f || physics_.mu_f > 2 * body.mu) momentum_.theta = 1;
    const Real light = physics_.rho / std::min(body.rho, physics_.rho);
    momentum_.bound_explicit_viscosity(light * std::max(body.mu, physics_.mu_f));
  }
  if (body.rho != physics_.rho && !heavy_) heavy_.emplace(mesh_, weights_, physics_.rho);
  if (body.two_viscosities) {
    if (!stiff_) stiff_.emplace(mesh_);
    momentum_.hold_old();
  }
  alphas_.push_back(&body.alpha);
  if (bodies_.size() > 1) {
    separation_.emplace(mesh_, bodies_.size());
    if (!mixed_mu_) mixed_mu_.emplace(mesh_);
  }
  mix_viscosity(mu_);
  mix_density();
  hold_backup();
}

void Solver::advance_interface(Body& body, const FaceField<Real>& phi, Real t) {
  const Profile::Call call(profile_, calls_.advance_interface);
  body.dt = t - body.t;
  body.t = t;
  body.alpha_mid.assign(body.alpha);
  // A flux follows the plane of one cell, for a part of the step in which the surface stays in it:
  // in whole steps the way of a thin curved body depends on dt (doc/theory/interface.md).
  constexpr Real courant = 0.2, parts_max = 10;
  const Real longest = vof::interface_dt(body.alpha, phi, courant, mesh_);
  const int parts = static_cast<int>(std::clamp(std::ceil(body.dt / longest), Real{1}, parts_max));
  body.advected = {};
  for (int i = 0; i < parts; ++i) {
    body.advected.add(vof::advect(body.alpha, body.interface, phi, state_.u, body.dt / parts, mesh_,
                                  body.advect_scratch));
    if (leaves_) body.count_out();
    vof::reconstruct(body.interface, body.alpha, mesh_, body.reconstruct_scratch, body.planes());
  }
  for (Index c = 0; c < mesh_.n_cells; ++c)
    body.alpha_mid[c] = (body.alpha_mid[c] + body.alpha[c]) / 2;
}

void Solver::separate_bodies() {
  const Profile::Call call(profile_, calls_.separate_bodies);
  if (!separation_) return;
  shared_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (const Index c : bodies_[i].band.core()) {
      const auto holds = [&](const Body& body) { return body.alpha[c] > 0; };
      const auto first = std::ranges::find_if(bodies_, holds);
      // listed once, by the first that holds the cell
      if (first - bodies_.begin() != static_cast<std::ptrdiff_t>(i)) continue;
      if (std::any_of(first + 1, bodies_.end(), holds)) shared_.push_back(c);
    }
  if (!separation_->apply(alphas_, shared_)) return;
  for (Body& body : bodies_)
    vof::reconstruct(body.interface, body.alpha, mesh_, body.reconstruct_scratch, body.planes());
}

void Solver::advect_pressure_jump(CellField<Real>& p, const Body& body) {
  const Profile::Call call(profile_, calls_.advect_pressure_jump);
  if (!body.advects_pressure_jump()) return;
  solid::advect_pressure_jump(p, body.alpha_mid, body.alpha, body.T(), body.G, mesh_,
                              body.band.cells());
  mesh_.halo.update(p);
}

void Solver::clear_forces() {
  if (!bodies_.empty() || driving_force_) force_.fill({});
  if (bodies_.empty()) return;
  rhie_chow_source_.fill(0);
  interface_L_f_.clear();
  for (Body& body : bodies_) body.semi_implicit_elasticity.clear(kappa_);
}

void Solver::set_L(CellField<Tensor>& L, const CellField<Vec3>& u, std::span<const Index> cells) {
  gradient(L, u, u_b_, u_stencil_, mesh_, cells);
  mesh_.halo.update(L);
}

void Solver::set_velocity_of_fluxes(CellField<Vec3>& u, const Body& body,
                                    const CellField<Tensor>& L, std::span<const Index> cells) {
  const solid::FlowSnapshot snapshot{state_.phi, state_.u, L, projection_.stencil().cells,
                                     weights_};
  u.assign(state_.u);
  for (const Index c : cells)
    if (body.alpha_mid[c] >= solid::alpha_known)
      u[c] = solid::velocity_of_fluxes(snapshot, body.alpha_mid, mesh_, c);
  mesh_.halo.update(u);
}

void Solver::take_interface_gradient(const Body& body, const CellField<Tensor>& L) {
  const Band& strained = body.strain_cells();
  const CellField<Real>& listed = strained.listed();
  for (const Index f : strained.faces()) {
    const Index i = weights_.place[f], P = mesh_.owner[f];
    if (i < 0) continue;
    const Index N = f < mesh_.n_internal ? mesh_.neighbour[f] : P;
    if (listed[P] == 0 || listed[N] == 0) continue;
    const Real lambda = f < mesh_.n_internal ? weights_.lambda[f] : 0;
    L_f_[i] = (1 - lambda) * L[P] + lambda * L[N];
    interface_L_f_.emplace_back(i, L_f_[i]);
  }
}

void Solver::transport_elastic(Body& body, CellField<Tensor>& L, const State& state) {
  const Profile::Call call(profile_, calls_.transport_elastic);
  auto& one_sided = body.interface_gradient;
  const bool by_flux = body.strain_by_flux();
  const solid::Contact contact{u_b_, body.touched};
  const solid::FlowSnapshot snapshot{.phi = state.phi,
                                     .u = by_flux ? by_flux_->u : state.u,
                                     .L = by_flux ? by_flux_->L : L,
                                     .stencil = projection_.stencil().cells,
                                     .weights = weights_,
                                     .strain = one_sided ? &one_sided->strain() : nullptr,
                                     .contact = &contact,
                                     .wave_speed = std::sqrt(body.G / body.rho),
                                     .recovery = body.G / body.mu};
  std::visit(
      [&](auto& k) {
        k.mark(body.strain_fraction());
        const auto cells = k.strain_cells();
        if (by_flux) {
          body.set_touched(cells, momentum_.boundary().open);
          set_velocity_of_fluxes(by_flux_->u, body, L, cells);
          set_L(by_flux_->L, by_flux_->u, cells);
        } else if (!needs_L()) {
          set_L(L, state.u, cells);
        }
        if (one_sided) {
          auto& kink = *body.kink_profile;
          kink.set(body.interface, weights_);
          one_sided->apply(L, state.u, u_b_,
                           {body.alpha, kink.normal, kink.solid_side, kink.fluid_side}, cells);
          one_sided->set_strain(L, state.u, u_b_, body.alpha, cells);
        }
        body.strain = k.transport(body.strain_fraction(), snapshot, body.dt, body.grad);
      },
      body.kinematics);
  body.update_B();
  if (one_sided) take_interface_gradient(body, L);
}

void Solver::mix_viscosity(FaceField<Real>& mu) {
  const Profile::Call call(profile_, calls_.mix_viscosity);
  if (!modes_.mu_varies) return;
  if (bodies_.size() == 1) {
    const Body& body = bodies_.front();
    flow::mixture_viscosity(mu, body.alpha, physics_.mu_f, body.mu, weights_, mesh_);
    return;
  }
  // mu = mu_f + sum_i (mu_i - mu_f) alpha_i / max(1, sum_j alpha_j)
  for (Index c = 0; c < mesh_.n_cells; ++c) {
    Real sum = 0, excess = 0;
    for (const Body& body : bodies_)
      sum += body.alpha[c], excess += (body.mu - physics_.mu_f) * body.alpha[c];
    (*mixed_mu_)[c] = excess / std::max(Real{1}, sum);
  }
  flow::mixture_viscosity(mu, *mixed_mu_, physics_.mu_f, physics_.mu_f + 1, weights_, mesh_);
}

void Solver::add_elastic_force(CellField<Vec3>& force, Body& body) {
  const Profile::Call call(profile_, calls_.add_elastic_force);
  const solid::ElasticState elastic{body.T(), body.alpha, body.extended() ? &body.alpha_f : nullptr,
                                    &body.normal_f, &body.mirror};
  PressureStencil& stencil = projection_.stencil();
  body.elastic_force.apply(force, rhie_chow_source_, elastic, weights_, stencil, body.band,
                           body.grad);
  if (body.two_viscosities) {
    auto& [traction, normal, height] = *body.two_viscosities;
    vof::cell_plane(normal, height, body.alpha, body.interface, mesh_, body.band.cells());
    mesh_.halo.update(normal, body.band.listed());
    traction.apply(force, rhie_chow_source_,
                   {state_.u, L_, L_f_, body.T(), body.alpha, body.alpha_f, body.normal_f, normal,
                    height, mu_},
                   weights_, stencil, body.band);
  }
  if (body.body_force)
    body.body_force->apply(force, rhie_chow_source_,
                           body.alpha_line ? *body.alpha_line : body.alpha_f, stencil, body.band);
}

void Solver::add_semi_implicit(FaceField<Real>& kappa, CellField<Vec3>& force, Real dt) {
  const Profile::Call call(profile_, calls_.add_semi_implicit);
  for (Body& body : bodies_) add_semi_implicit(kappa, force, body, dt);
  if (!stiff_) return;
  stiff_->assign(kappa);
  for (const Body& body : bodies_)
    if (body.two_viscosities)
      body.two_viscosities->traction.add_semi_implicit(*stiff_, body.alpha_f, body.band);
}

void Solver::add_semi_implicit(FaceField<Real>& kappa, CellField<Vec3>& force, Body& body,
                               Real dt) {
  if (!body.semi_implicit()) return;
  if (!needs_L()) {
    gradient(L_, state_.u, u_b_, u_stencil_, mesh_, body.band.cells());
    mesh_.halo.update(L_, body.band.listed());
  }
  // A map is less accurate with less damping where the surface lies in mid-cell.
  const bool map = std::holds_alternative<solid::ReferenceMap>(body.kinematics);
  const solid::ElasticTerms terms{
      .lambda = body.lambda,
      .alpha = body.alpha_f,
      .u = state_.u,
      .L = L_,
      .fraction = body.alpha,
      .G = body.G,
      .rho = body.rho,
      .mu_s = map ? 0 : body.mu,
      .dt = dt,
      .rho_least = std::min(body.rho, physics_.rho),
      .kink = !map,
      .one_sided = body.interface_gradient.has_value(),
      .normal = body.two_viscosities ? &body.two_viscosities->normal : nullptr};
  body.semi_implicit_elasticity.apply(kappa, force, terms, weights_, body.band);
}

}  // namespace fsi
