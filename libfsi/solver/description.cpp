// The text of -describe_step: what each call of a step does in this scene (doc/theory/step.md).

#include <algorithm>
#include <array>
#include <cstdio>

#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

/// The actions of the calls that work on a solid, for this solid; "": nothing.
struct OfBody {
  std::string hold, advance, jump, memory, elastic, force, implicit;
};

std::string elastic(const Body& body) {
  if (std::holds_alternative<solid::LeftCauchyGreen>(body.kinematics))
    return "alpha^(1/2) B carried by the fluxes and strained by grad u";
  std::string what = "the map carried by the fluxes";
  if (!std::holds_alternative<solid::ReferenceMap>(body.kinematics)) {
    what = "log B carried by the fluxes and strained by ";
    if (body.strain_by_flux()) what += "L corrected by the fluxes";
    if (body.strain_by_flux() && body.interface_gradient) what += ", at triangles and tetrahedra ";
    if (body.interface_gradient) what += "a quadratic one-sided fit of L";
    if (body.remembers()) what += ", relaxed towards the memory";
    what += "; L of outermost cells bounded by the work of the force";
  }
  return what + (body.film ? "; cells at a film on a wall extrapolated from inside" : "");
}

std::string force(const Body& body) {
  std::string what = body.extended() ? "div tau by the part of solid between cell centres"
                                     : "div tau by alpha averaged linearly";
  if (body.traction) what += "; traction between two viscosities";
  if (body.body_force) what += "; weight and body force of the solid";
  return what;
}

OfBody calls_of(const Body& body) {
  OfBody calls;
  if (body.map() != nullptr && body.held) calls.hold = "alpha moved towards the shape of the map";
  calls.advance = body.time_offset() < 1 ? "to half a step after t" : "to the end of the step";
  if (body.advects_pressure_jump()) calls.jump = "pressure jump moved with the surface";
  if (body.remembers()) calls.memory = "the memory carried with the flow";
  calls.elastic = elastic(body);
  calls.force = force(body);
  if (body.semi_implicit()) {
    calls.implicit = "kappa = 0.4 dt G alpha_f lambda or what e needs; b kappa dt u . grad L; e";
    if (body.traction) calls.implicit += "; a part of the traction";
  }
  return calls;
}

/// The action of a call on each solid; with their names if there are several.
std::string of_bodies(const std::deque<Body>& bodies, std::string OfBody::*call) {
  std::string line;
  for (const Body& body : bodies) {
    const std::string what = calls_of(body).*call;
    if (what.empty()) continue;
    if (!line.empty()) line += " | ";
    line += (bodies.size() > 1 ? body.name + ": " : "") + what;
  }
  return line;
}

std::string numbered(std::size_t call, const char* name, const std::string& what) {
  std::array<char, 48> head{};
  std::snprintf(head.data(), head.size(), "(%2zu) %-22s ", call, name);
  return head.data() + (what.empty() ? "nothing" : what);
}

/// Whether the stress of a solid damps the flux.
bool stress_damps(const std::deque<Body>& bodies) {
  return std::ranges::any_of(bodies,
                             [](const Body& body) { return body.semi_implicit() && body.G > 0; });
}

/// The implicit part of the momentum equation, from that of the bodies.
std::string with_convection(const std::string& of_bodies, bool convection) {
  if (!convection) return of_bodies;
  const std::string cells = "convection of triangles and tetrahedra beyond its explicit limit";
  return of_bodies.empty() ? cells : cells + "; " + of_bodies;
}

}  // namespace

std::vector<std::string> Solver::describe_step() const {
  const auto solids = [&](std::string OfBody::*call) { return of_bodies(bodies_, call); };
  const auto where = [](bool holds, const char* what) { return std::string(holds ? what : ""); };
  const bool loaded = std::ranges::any_of(conditions_, [](const Condition& one) {
    return fixes_pressure(one) || prescribes_flow(one);
  });
  std::string viscosity = where(modes_.mu_varies, "mu of fluid and solids by alpha");
  if (modes_.films)
    viscosity += std::string(viscosity.empty() ? "" : "; ") + "that of the film at walls";
  if (wall_parabola_.any() && !bodies_.empty())
    viscosity += std::string(viscosity.empty() ? "" : "; ") + "no parabola of walls at the solids";
  const std::array<std::pair<const char*, std::string>, 19> calls{{
      {"hold_shape", solids(&OfBody::hold)},
      {"advance_interface", solids(&OfBody::advance)},
      {"separate_bodies", where(separation_.has_value(), "sum of the fractions limited to 1")},
      {"advect_pressure_jump", solids(&OfBody::jump)},
      {"set_pressure_gradient", projection_.orthogonal() ? "grad p, adjoint of the flux"
                                : loaded ? "grad p with the pressure of the openings"
                                         : "grad p"},
      {"set_velocity_gradient", needs_L() ? "grad u in all cells" : "u at the boundary"},
      {"transport_memory", solids(&OfBody::memory)},
      {"transport_elastic", solids(&OfBody::elastic)},
      {"mix_viscosity", viscosity},
      {"mix_density", where(heavy_.has_value(), "rho of fluid and solids, new pressure matrix")},
      {"add_elastic_force", solids(&OfBody::force)},
      {"add_semi_implicit", with_convection(solids(&OfBody::implicit), modes_.implicit_convection)},
      {"add_body_force", where(static_cast<bool>(driving_force_), "f(x, t + dt/2)")},
      {"balance_weight", where(at_rest_.has_value(), "first step: p balances forces and weight")},
      {"set_flux_excess", where(!projection_.orthogonal(), "flux less the mean of u")},
      {"predict_momentum", "u*, convection " + flow::name_of(momentum_.scheme())},
      {"predict_flux", std::string("phi* of u*") +
                           (stress_damps(bodies_) ? ", damped by the term in lambda_B" : "")},
      {"project", projection_.orthogonal() ? "u orthogonally, then phi; p"
                  : loaded                 ? "p, u and phi, with the answers of the openings"
                                           : "p, u and phi"},
      {"hold_mean_velocity", where(forcing_.has_value(), "mean velocity as given")},
  }};
  std::vector<std::string> lines;
  for (const auto& [name, what] : calls) lines.push_back(numbered(lines.size() + 1, name, what));
  return lines;
}

}  // namespace fsi
