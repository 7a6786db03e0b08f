// How a solid is put into a solver.

#include <algorithm>
#include <cmath>
#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/solver/solver.hpp"

namespace fsi {
namespace {

std::string called(const Body& body) {
  return body.name.empty() ? "the solid" : "solid \"" + body.name + "\"";
}

/// Errors: Error{input} where a figure of the material is not finite or out of its bounds, those of
/// the options of the drivers.
void require_material(const Solid& solid, const Physics& physics) {
  const std::string which = solid.name.empty() ? "the solid" : "solid \"" + solid.name + "\"";
  require(solid.G >= 0 && std::isfinite(solid.G),
          which + print(": G is %g and must be a number >= 0", solid.G));
  require(solid.mu >= 0 && std::isfinite(solid.mu),
          which + print(": mu is %g and must be a number >= 0", solid.mu));
  require(physics.mu_f <= 0 || solid.mu <= viscosity_ratio_max * physics.mu_f,
          which + print(": mu is %g and must be at most %g times that of the fluid", solid.mu,
                        viscosity_ratio_max));
  require(
      solid.rho == 0 || (solid.rho >= density_ratio_min * physics.rho &&
                         solid.rho <= density_ratio_max * physics.rho),
      which + print(": rho is %g and must be %g to %g times that of the fluid, or 0 for the same",
                    solid.rho, density_ratio_min, density_ratio_max));
}

/// Errors: Error{input} where the body that was made of `solid` does not fit among the others.
void require_place(const Body& body, const Solid& solid, const std::deque<Body>& others,
                   const Mesh& mesh) {
  const std::string which = called(body), sizes = solid.by_default.empty()
                                                      ? ""
                                                      : "; by default it has " + solid.by_default;
  if (!(body.filled.volume > 0))
    throw Error(ErrorKind::input,
                which + " is empty: its shape lies outside the mesh or is smaller than a cell" +
                    sizes + "; the mesh reaches " + text_of(extent(mesh)) +
                    ": look whether it lies within the fluid, and both are in the same unit");
  const Real touching = 1e-9 * std::pow(mesh.total_volume, 1.0 / mesh.dim);
  require(solid.trim || body.filled.clearance > -touching,
          which + " sticks out of the mesh, whose boundary reaches " +
              print("%.4g", -body.filled.clearance) +
              " deep into it: move it or make it smaller, " +
              "or let the mesh cut it (option trim of the solid)" + sizes);
  constexpr Real rounding = 1e-6;
  require(
      body.filled.steepest <= 1 + rounding,
      which + print(": the value of its shape changes by up to %.4g times the way between cells "
                    "at its surface, and a signed distance by no more than the way; divide it "
                    "by the largest slope that it has",
                    body.filled.steepest));
  require(!body.filled.overlaps_itself,
          which +
              " is longer than a period of the mesh and overlaps its own image: make it smaller, "
              "or of several periods for one without ends" +
              sizes);
  require(!body.filled.touches_itself,
          which +
              " touches its own image across a period of the mesh: make it smaller, or of several "
              "periods for one without ends" +
              sizes);
  for (const Body& other : others) {
    if (&other == &body || solid.from_checkpoint) continue;
    Real most = 0;
    for (Index c = 0; c < mesh.n_owned; ++c)
      if (body.alpha[c] > 0 && other.alpha[c] > 0)
        most = std::max(most, body.alpha[c] + other.alpha[c] - 1);
    constexpr Real error_of_fill = 1e-3;
    require(global_max(most) < error_of_fill,
            which + " overlaps " + called(other) + " at the start: move one of them" + sizes);
  }
}

/// Collective. Errors: Error{input} where a plane of symmetry cuts the body and its weight acts
/// across it: the image would have another weight.
void require_symmetric_weight(const Body& body, const std::vector<Patch>& mirrors,
                              const Mesh& mesh) {
  constexpr Real rounding = 1e-9;
  for (const Patch& patch : mirrors) {
    bool along = true;
    for (Index f = patch.begin; f < patch.end; ++f)
      if (body.filled.cut_by.faces[f - mesh.n_internal] != 0)
        along = along && std::abs(dot(body.weight, mesh.Sf[f])) <=
                             rounding * norm(body.weight) * norm(mesh.Sf[f]);
    require(all_of_ranks(along),
            called(body) + " is cut by the plane of symmetry \"" + patch.name +
                "\", and its weight or acceleration acts across this plane, where its image has "
                "the opposite one: give a mesh of the whole scene");
  }
}

/// Errors: Error{input} where the body has a cell between two of these planes, which then has no
/// neighbour that tells how anything varies across them.
void require_depth(const Body& body, const std::vector<Patch>& planes, const Mesh& mesh) {
  constexpr Real facing = -0.7;  // cosine
  const auto on_plane = [&](Index f) {
    return std::ranges::any_of(planes, [&](const Patch& p) { return f >= p.begin && f < p.end; });
  };
  bool deep = true;
  for (const Patch& plane : planes)
    for (Index f = plane.begin; f < plane.end; ++f) {
      const Index P = mesh.owner[f];
      if (!(body.alpha[P] > 0)) continue;
      for (const Index g : mesh.cell_faces[P]) {
        const Real turn = dot(mesh.Sf[f], mesh.Sf[g]) / (norm(mesh.Sf[f]) * norm(mesh.Sf[g]));
        deep = deep && !(on_plane(g) && turn < facing);
      }
    }
  require(all_of_ranks(deep),
          called(body) +
              " lies in cells between two planes of symmetry, and one layer of cells is "
              "too thin for a solid: give a mesh in two dimensions, or several layers");
}

SolidPatches patches_of_solids(const std::vector<Condition>& conditions, const Mesh& mesh) {
  SolidPatches patches;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Condition& here = conditions[i];
    const Patch& patch = mesh.patches[i];
    if (lets_slip(here)) patches.mirrors.push_back(patch);
    if (fixes_velocity(here)) patches.walls.push_back(patch);
    if (const auto* wall = std::get_if<Wall>(&here)) {
      patches.tight.push_back(patch);
      if (wall->velocity == Vec3{}) patches.still.push_back(patch);
    }
    if (fixes_pressure(here) || prescribes_flow(here)) patches.openings.push_back(patch);
  }
  return patches;
}

}  // namespace

void Solver::require_bodies() const {
  if (bodies_.size() == fractions_.size()) return;  // no sentence is made in every step
  throw Error(ErrorKind::input,
              "the list bodies() of the solver has length " + std::to_string(bodies_.size()) +
                  ", but put_solid put in " + std::to_string(fractions_.size()) +
                  ": solids are put in by put_solid alone, and none is taken out; for a scene " +
                  "without one make a new Solver");
}

void Solver::put_solid(const Solid& solid) {
  require_bodies();
  require(!projection_.orthogonal(),
          "an orthogonal projection (-flow_projection) is for a fluid without solids");
  require(mesh_.dim == 3 || solid.acceleration.z == 0,
          print("the acceleration of a solid has the component %g along z, but a mesh of two "
                "dimensions lies in the x-y plane, and nothing moves out of it",
                solid.acceleration.z));
  require_material(solid, physics_);
  for (const Body& other : bodies_)
    require(other.name != solid.name, "two solids have the name \"" + solid.name + "\"");
  const SolidPatches patches = patches_of_solids(conditions_, mesh_);
  bodies_.emplace_back(mesh_, weights_, solid, physics_, patches);
  Body& body = bodies_.back();
  body.t = state_.t;
  body.begun = state_.step;
  body.t_begun = state_.t;
  try {
    require_place(body, solid, bodies_, mesh_);
    require_symmetric_weight(body, patches.mirrors, mesh_);
    require_depth(body, patches.mirrors, mesh_);
  } catch (const Error&) {
    bodies_.pop_back();  // all ranks throw alike
    throw;
  }
  set_modes(body);
  fractions_.push_back({.alpha = &body.alpha, .mid = &body.alpha_mid});
  if (bodies_.size() > 1) {
    separation_.emplace(mesh_, bodies_.size());
    if (modes_.one_sided && !side_gradients_) side_gradients_.emplace(mesh_);
    if (!mixed_mu_) mixed_mu_.emplace(mesh_);
  }
  mix_viscosity(mu_);
  mix_density();
  hold_backup();
}

std::int64_t Solver::begun() const {
  std::int64_t last = 0;
  for (const Body& body : bodies_) last = std::max(last, body.begun);
  return last;
}

Real Solver::t_begun() const {
  Real last = 0;
  for (const Body& body : bodies_) last = std::max(last, body.t_begun);
  return last;
}

void Solver::set_modes(const Body& body) {
  // theta at one-sided faces moves with the surface, as kappa does.
  modes_.stiff =
      modes_.stiff || (body.semi_implicit() && body.G > 0) || body.interface_gradient.has_value();
  modes_.one_sided = modes_.one_sided || body.interface_gradient;
  modes_.G = std::max(modes_.G, body.G);
  modes_.rho_least = std::min({modes_.rho_least, physics_.rho, body.rho});
  const bool thin = body.film && body.film_thickness > 0;
  modes_.films = modes_.films || thin || (body.film && body.mu != physics_.mu_f);
  modes_.stiff = modes_.stiff || thin;  // mu at walls changes, so the matrix is assembled anew
  if (body.strain_by_flux() && !by_flux_) by_flux_.emplace(mesh_);
  if (body.mu != physics_.mu_f) {
    modes_.mu_varies = true;
    // The transposed viscous term is explicit: backward Euler where it is large.
    if (body.mu > 2 * physics_.mu_f || physics_.mu_f > 2 * body.mu) momentum_.theta = 1;
  }
  if (modes_.mu_varies) {
    Real most = physics_.mu_f;
    for (const Body& one : bodies_) {
      most = std::max(most, one.mu);
      if (one.film && one.film_thickness > 0)
        most = std::max(most, physics_.mu_f * one.film->largest_depth() / one.film_thickness);
    }
    momentum_.bound_explicit_viscosity(physics_.rho / modes_.rho_least * most);
  }
  if (body.rho != physics_.rho && !heavy_) heavy_.emplace(mesh_, weights_, physics_.rho);
  if ((heavy_ || body.body_force) && !at_rest_) at_rest_.emplace(AtRest{mesh_});
  if (body.traction) {
    if (!stiff_) stiff_.emplace(mesh_);
    momentum_.hold_old();
  }
}

}  // namespace fsi
