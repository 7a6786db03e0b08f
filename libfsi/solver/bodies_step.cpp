// The calls of a step on all solids of a solver, in the order of the step.

#include <algorithm>

#include "libfsi/solver/solver.hpp"

namespace fsi {

FlowAround Solver::flow_around() {
  return {.u = state_.u,
          .phi = state_.phi,
          .u_b = u_b_,
          .open = momentum_.boundary().open,
          .u_stencil = u_stencil_,
          .pressure = projection_.stencil(),
          .L_f = L_f_,
          .mu = mu_,
          .by_flux = by_flux_ ? &*by_flux_ : nullptr,
          .rho_least = modes_.rho_least,
          .has_L = needs_L(),
          .leaves = leaves_};
}

void Solver::hold_shape(Body& body) {
  const Profile::Call call(profile_, calls_.hold_shape);
  fsi::hold_shape(body);
}

void Solver::advance_interface(Body& body, Real t) {
  const Profile::Call call(profile_, calls_.advance_interface);
  fsi::advance_interface(body, flow_around(), t);
}

void Solver::separate_bodies() {
  const Profile::Call call(profile_, calls_.separate_bodies);
  if (!separation_) return;
  shared_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    for (const Index c : bodies_[i].band.cells()) {  // of before the motion, so with those around
      const auto end = bodies_.begin() + static_cast<std::ptrdiff_t>(i);
      const auto lists = [&](const Body& body) { return body.band.listed()[c] != 0; };
      if (std::any_of(bodies_.begin(), end, lists)) continue;  // seen in the band of that one
      const auto holds = [&](const Body& body) { return body.alpha[c] > 0; };
      if (std::ranges::count_if(bodies_, holds) > 1) shared_.push_back(c);
    }
  if (!separation_->apply(fractions_, shared_)) return;
  for (Body& body : bodies_)
    vof::reconstruct(body.interface, body.alpha, mesh_, body.reconstruct_scratch, body.planes());
}

void Solver::advect_pressure_jump(CellField<Real>& p, const Body& body) {
  const Profile::Call call(profile_, calls_.advect_pressure_jump);
  fsi::advect_pressure_jump(p, body);
}

void Solver::clear_forces() {
  if (!bodies_.empty() || driving_force_) force_.fill({});
  if (bodies_.empty()) return;
  rhie_chow_source_.fill(0);
  interface_faces_.clear();
  interface_L_f_.clear();
  for (Body& body : bodies_) body.semi_implicit_elasticity.clear(kappa_, stiffness_);
}

void Solver::transport_memory(Body& body, CellField<Tensor>& L) {
  const Profile::Call call(profile_, calls_.transport_memory);
  fsi::transport_memory(body, L, flow_around());
}

void Solver::take_interface_gradient(const Body& body, const CellField<Tensor>& L) {
  const Band& strained = body.strain_cells();
  const CellField<Real>& listed = strained.listed();
  for (const Index f : strained.faces()) {
    const Index i = weights_.place[f], P = mesh_.owner[f];
    if (i < 0) continue;
    const Index N = f < mesh_.n_internal ? mesh_.neighbour[f] : P;
    if (listed[P] == 0 || listed[N] == 0) continue;
    if (!body.zone.has(P) && !body.zone.has(N)) continue;
    const Real lambda = f < mesh_.n_internal ? weights_.lambda[f] : 0;
    L_f_[i] = (1 - lambda) * L[P] + lambda * L[N];
    interface_faces_.push_back(f);
    interface_L_f_.push_back(L_f_[i]);
  }
}

void Solver::transport_elastic(CellField<Tensor>& L) {
  const Profile::Call call(profile_, calls_.transport_elastic);
  if (side_gradients_) side_gradients_->begin(L);
  for (Body& body : bodies_) {
    fsi::transport_elastic(body, L, flow_around());
    if (side_gradients_) side_gradients_->keep(L, body);
  }
  if (side_gradients_) side_gradients_->merge(L, bodies_);
  for (const Body& body : bodies_)
    if (body.interface_gradient) take_interface_gradient(body, L);
}

void Solver::set_wall_parabola() {
  if (bodies_.empty() || !wall_parabola_.any()) return;
  wall_parabola_.reset();
  for (const Body& body : bodies_) wall_parabola_.keep_off(body.alpha, body.band.cells());
}

void Solver::mix_viscosity(FaceField<Real>& mu) {
  const Profile::Call call(profile_, calls_.mix_viscosity);
  if (modes_.mu_varies && bodies_.size() == 1) {
    const Body& body = bodies_.front();
    flow::mixture_viscosity(mu, body.alpha, physics_.mu_f, body.mu, weights_, mesh_);
  } else if (modes_.mu_varies) {
    // mu = mu_f + sum_i (mu_i - mu_f) alpha_i / max(1, sum_j alpha_j)
    for (Index c = 0; c < mesh_.n_cells; ++c) {
      Real sum = 0, excess = 0;
      for (const Body& body : bodies_)
        sum += body.alpha[c], excess += (body.mu - physics_.mu_f) * body.alpha[c];
      (*mixed_mu_)[c] = excess / std::max(Real{1}, sum);
    }
    flow::mixture_viscosity(mu, *mixed_mu_, physics_.mu_f, physics_.mu_f + 1, weights_, mesh_);
  }
  for (const Body& body : bodies_)
    if (body.traction)
      body.traction->bound_viscosity(mu, {body.alpha_f, body.normal_f, body.alpha}, body.band);
  set_wall_parabola();
  if (!modes_.films) return;
  if (!modes_.mu_varies)
    std::fill(mu.data() + mesh_.n_internal, mu.data() + mesh_.n_faces, physics_.mu_f);
  for (const Body& body : bodies_)
    if (body.film) body.film->set_viscosity(mu, body.alpha, physics_.mu_f);
  const auto thin = [](const Body& body) { return body.film && body.film_thickness > 0; };
  for (const Body& body : bodies_)
    if (thin(body)) body.film->thin(mu, body.alpha, body.alpha_f, physics_.mu_f);
  for (const Body& body : bodies_)
    if (thin(body)) body.film->bound_viscosity(mu, body.alpha, physics_.mu_f, body.film_thickness);
}

void Solver::add_elastic_force(CellField<Vec3>& force, Body& body) {
  const Profile::Call call(profile_, calls_.add_elastic_force);
  fsi::add_elastic_force(force, rhie_chow_source_, body, L_, flow_around());
}

void Solver::add_semi_implicit(FaceField<Real>& kappa, FaceField<Real>& stiffness,
                               CellField<Vec3>& force, Real dt) {
  const Profile::Call call(profile_, calls_.add_semi_implicit);
  const FlowAround flow = flow_around();
  for (Body& body : bodies_) fsi::add_semi_implicit(kappa, stiffness, force, body, L_, flow, dt);
  if (!stiff_) return;
  stiff_->assign(kappa);
  for (const Body& body : bodies_)
    if (body.traction) body.traction->add_semi_implicit(*stiff_, kappa, body.alpha_f, body.band);
  if (!modes_.implicit_convection) return;
  Real rho = physics_.rho;
  for (const Body& body : bodies_) rho = std::max(rho, body.rho);
  courant_.add_implicit(*stiff_, state_.phi, rho, dt, weights_);
}

}  // namespace fsi
