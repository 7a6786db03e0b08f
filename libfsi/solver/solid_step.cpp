#include "libfsi/solver/solid_step.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/solid/pressure_jump.hpp"
#include "libfsi/solid/solenoidal.hpp"
#include "libfsi/solid/velocity_kink.hpp"
#include "libfsi/vof/motion.hpp"

namespace fsi {
namespace {

/// L = grad u on the listed owned cells; its halo.
void set_L(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
           const FlowAround& flow, const Mesh& mesh, std::span<const Index> cells) {
  gradient(L, u, u_b, flow.u_stencil, mesh, cells);
  mesh.halo.update(L);
}

/// u = the flow's; in the known ones of the listed cells utilde, corrected by the fluxes
/// (solenoidal.hpp); owned and halo. u_b = the flow's, on planes of symmetry the part of u along
/// the plane.
void set_velocity_of_fluxes(CellField<Vec3>& u, BoundaryField<Vec3>& u_b, const Body& body,
                            const CellField<Tensor>& L, const FlowAround& flow,
                            std::span<const Index> cells) {
  const Mesh& mesh = body.mesh;
  const solid::FlowSnapshot snapshot{flow.phi, flow.u, L, flow.pressure.cells, body.weights};
  u.assign(flow.u), u_b.assign(flow.u_b);
  for (const Index c : cells) {
    if (body.alpha_mid[c] < solid::alpha_known || body.zone.has(c)) continue;
    u[c] = solid::velocity_of_fluxes(snapshot, body.alpha_mid, mesh, c);
    for (const Index f : mesh.cell_faces[c])
      if (body.mirror.has(f, mesh))
        u_b[f - mesh.n_internal] = u[c] - (dot(u[c], mesh.Sf[f]) / norm2(mesh.Sf[f])) * mesh.Sf[f];
  }
  mesh.halo.update(u);
}

const solid::InterfaceGradient* one_sided_of(const Body& body) {
  return body.interface_gradient ? &*body.interface_gradient : nullptr;
}

/// The flow that carries psi, the memory or the map kinematics, without the surface's fields.
solid::FlowSnapshot snapshot_of(const Body& body, const CellField<Vec3>& u,
                                const CellField<Tensor>& L, const FlowAround& flow) {
  return {.phi = flow.phi,
          .u = u,
          .L = L,
          .stencil = flow.pressure.cells,
          .weights = body.weights,
          .one_sided = one_sided_of(body),
          .wave_speed = body.wave_speed(),
          .recovery = body.G > 0 ? body.G / body.mu : 0,
          .memory = body.remembers() ? &*body.memory : nullptr};
}

/// L = that of one side in the zone; the halo too.
void take_zone(CellField<Tensor>& L, const CellField<Tensor>& of_one_side, const Body& body) {
  for (Index c = 0; c < body.mesh.n_cells; ++c)
    if (body.zone.has(c)) L[c] = of_one_side[c];
}

}  // namespace

void hold_shape(Body& body) { body.hold_shape(); }

void advance_interface(Body& body, const FlowAround& flow, Real t) {
  body.dt = t - body.t;
  body.t = t;
  body.alpha_mid.assign(body.alpha);
  // A flux follows the plane of one cell, for a part of the step in which the surface stays in it:
  // in whole steps the way of a thin curved body depends on dt (doc/theory/interface.md).
  constexpr Real courant = 0.2, parts_max = 10;
  const Real longest = vof::interface_dt(body.alpha, flow.phi, courant, body.mesh);
  const int parts = static_cast<int>(std::clamp(std::ceil(body.dt / longest), Real{1}, parts_max));
  body.interface_parts = parts;
  body.advected = {};
  for (int i = 0; i < parts; ++i) {
    body.advected.add(vof::advect(body.alpha, body.interface, flow.phi, flow.u, body.dt / parts,
                                  body.mesh, body.advect_scratch));
    if (flow.leaves) body.count_out();
    vof::reconstruct(body.interface, body.alpha, body.mesh, body.reconstruct_scratch,
                     body.planes());
  }
  for (Index c = 0; c < body.mesh.n_cells; ++c)
    body.alpha_mid[c] = (body.alpha_mid[c] + body.alpha[c]) / 2;
}

void advect_pressure_jump(CellField<Real>& p, const Body& body) {
  if (!body.advects_pressure_jump()) return;
  solid::advect_pressure_jump(p, body.alpha_mid, body.alpha, body.T(), body.G, body.mesh,
                              body.band.cells(), body.reconstruct_scratch.symmetry);
  body.mesh.halo.update(p);
}

void transport_memory(Body& body, CellField<Tensor>& L, const FlowAround& flow) {
  if (!body.remembers()) return;
  solid::ReferenceMap& map = *body.memory;
  map.mark(body.alpha);
  if (!flow.has_L) set_L(L, flow.u, flow.u_b, flow, body.mesh, map.strain_cells());
  solid::FlowSnapshot snapshot = snapshot_of(body, flow.u, L, flow);
  if (body.film) {
    body.film->set(body.alpha);
    snapshot.inside = &body.film->fraction();
  }
  // The memory holds the interface, so it goes in parts with it: two at most, since each costs as
  // much as one of the whole step (doc/notebook/2026-11-27-along-the-path.md).
  const int parts = std::min(body.interface_parts, 2);
  for (int i = 0; i < parts; ++i) map.transport(body.alpha, snapshot, body.dt / parts, body.grad);
}

void transport_elastic(Body& body, CellField<Tensor>& L, const FlowAround& flow) {
  auto& one_sided = body.interface_gradient;
  const bool by_flux = body.strain_by_flux();
  const CellField<Real>& fraction = body.fraction_of_strain();
  if (body.film) body.film->set(fraction);
  const solid::Contact contact{flow.u_b, body.touched};
  const solid::CutFaces cuts{body.alpha_f, body.normal_f, fraction};
  solid::FlowSnapshot snapshot = by_flux ? snapshot_of(body, flow.by_flux->u, flow.by_flux->L, flow)
                                         : snapshot_of(body, flow.u, L, flow);
  snapshot.contact = &contact;
  snapshot.cuts = &cuts;
  if (body.traction) snapshot.in_series = body.traction->in_series();
  std::visit(
      [&](auto& k) {
        k.mark(body.strain_fraction());
        const auto cells = k.strain_cells();
        if (by_flux) {
          body.set_touched(cells, flow.open);
          auto& [u, u_b, L_of_u] = *flow.by_flux;
          set_velocity_of_fluxes(u, u_b, body, L, flow, cells);
          set_L(L_of_u, u, u_b, flow, body.mesh, cells);
        } else if (!flow.has_L) {
          set_L(L, flow.u, flow.u_b, flow, body.mesh, cells);
        }
        if (one_sided) {
          auto& kink = *body.kink_profile;
          kink.set(body.interface, body.weights, body.cut);
          one_sided->apply(L, flow.u, flow.u_b,
                           {fraction, kink.normal, kink.solid_side, kink.fluid_side}, cells);
          one_sided->set_strain(L, flow.u, flow.u_b, fraction, cells);
          if (by_flux) take_zone(flow.by_flux->L, L, body);
        }
        body.strain = k.transport(body.strain_fraction(), snapshot, body.dt, body.grad);
      },
      body.kinematics);
  body.update_B();
}

void add_elastic_force(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, Body& body,
                       const CellField<Tensor>& L, const FlowAround& flow) {
  const solid::ElasticState elastic{.T = body.T(),
                                    .alpha = body.alpha,
                                    .alpha_f = body.extended() ? &body.alpha_f : nullptr,
                                    .normal = &body.normal_f,
                                    .mirror = &body.mirror,
                                    .open = &flow.open,
                                    .film = body.film ? &body.film->faces() : nullptr};
  body.elastic_force.apply(force, rhie_chow_source, elastic, body.weights, flow.pressure, body.band,
                           body.grad);
  if (body.traction)
    body.traction->apply(force, rhie_chow_source,
                         {flow.u, L, flow.L_f, body.T(), body.alpha, body.alpha_f, body.normal_f,
                          body.normal, body.height, flow.mu},
                         flow.pressure, body.band);
  add_weight(force, rhie_chow_source, body, flow.pressure);
}

void add_weight(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source, Body& body,
                PressureStencil& pressure) {
  if (!body.body_force) return;
  body.body_force->apply(force, rhie_chow_source, body.alpha_line ? *body.alpha_line : body.alpha_f,
                         pressure, body.band);
}

void add_semi_implicit(FaceField<Real>& kappa, FaceField<Real>& stiffness, CellField<Vec3>& force,
                       Body& body, CellField<Tensor>& L, const FlowAround& flow, Real dt) {
  if (!body.semi_implicit()) return;
  if (!flow.has_L) {
    gradient(L, flow.u, flow.u_b, flow.u_stencil, body.mesh, body.band.cells());
    // In the whole halo: L in the bands of the bodies before stays.
    body.mesh.halo.update(L);
  }
  // The map kinematics is less accurate with less damping where the surface lies in mid-cell.
  const bool map = std::holds_alternative<solid::ReferenceMap>(body.kinematics);
  const solid::ElasticTerms terms{.lambda = body.lambda,
                                  .alpha = body.alpha_f,
                                  .u = flow.u,
                                  .L = L,
                                  .fraction = body.alpha,
                                  .G = body.G,
                                  .rho = body.rho,
                                  .mu_s = map ? 0 : body.mu,
                                  .dt = dt,
                                  .kink = !map,
                                  .one_sided = body.interface_gradient.has_value(),
                                  .normal = map && !body.traction ? nullptr : &body.normal_f,
                                  .across = body.traction ? 0.0 : 2.0,
                                  .rho_least = flow.rho_least};
  body.semi_implicit_elasticity.apply(kappa, stiffness, force, terms, body.weights, body.band);
}

void add_kinks(Kinks& kinks, const Body& body, const CellField<Tensor>& L, Real mu_f) {
  if (!body.semi_implicit() || (body.G == 0 && body.mu == mu_f)) return;
  solid::add_kinks(kinks, {body.alpha_f, body.alpha, L}, body.zone, body.band, body.mesh);
}

}  // namespace fsi
