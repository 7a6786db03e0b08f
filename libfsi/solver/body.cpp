#include "libfsi/solver/body.hpp"

#include <algorithm>
#include <array>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/vof/symmetry.hpp"

namespace fsi {
namespace {

/// A part of a solid's volume. So much of it may go through the boundary by rounding, as through
/// planes of symmetry.
constexpr Real rounding_out = 1e-12;

/// [n_boundary] 1 on the faces of these patches, else 0.
std::vector<char> on_faces(const std::vector<Patch>& patches, const Mesh& mesh) {
  std::vector<char> is(static_cast<std::size_t>(mesh.n_boundary()), 0);
  for (const Patch& patch : patches)
    for (Index f = patch.begin; f < patch.end; ++f) is[f - mesh.n_internal] = 1;
  return is;
}

Kinematics make(const Mesh& mesh, KinematicsKind kind, const SymmetryFaces& symmetry) {
  if (kind == KinematicsKind::left_cauchy_green) return solid::LeftCauchyGreen(mesh, symmetry);
  if (kind == KinematicsKind::reference_map)
    return solid::ReferenceMap(mesh, solid::ReferenceMap::Role::alone, {}, symmetry);
  return solid::LogConformation(mesh, symmetry);
}

}  // namespace

std::string name_of(const Kinematics& kinematics) {
  if (std::holds_alternative<solid::LeftCauchyGreen>(kinematics)) return "left_cauchy_green";
  if (std::holds_alternative<solid::ReferenceMap>(kinematics)) return "reference_map";
  return "log_conformation";
}

Body::Body(const Mesh& mesh_, const FaceWeights& weights_, const Solid& solid,
           const Physics& physics, const SolidPatches& patches)
    : mesh(mesh_),
      weights(weights_),
      zone(mesh),
      name(solid.name),
      G(solid.G),
      mu(solid.mu),
      rho(solid.rho > 0 ? solid.rho : physics.rho),
      weight(rho * solid.acceleration + (rho - physics.rho) * physics.gravity),
      alpha(mesh),
      filled(vof::fill(alpha, mesh, solid.shape, patches.mirrors)),
      cut(filled.cut_by.faces, mesh),
      alpha_mid(mesh),
      B(mesh),
      alpha_f(mesh),
      normal(mesh),
      height(mesh),
      normal_f(mesh),
      lambda(mesh),
      law(solid.law),
      touched(mesh),
      interface(mesh),
      reconstruct_scratch(mesh, cut),
      advect_scratch(mesh, cut),
      band(mesh),
      kinematics(make(mesh, solid.kinematics, cut)),
      elastic_force(mesh, weights, G),
      mirror(on_faces(patches.mirrors, mesh), mesh),
      semi_implicit_elasticity(mesh, weights, zone, mirror),
      wave_width(solid::wave_widths(
          mesh, semi_implicit() ? solid::WaveWidth::of_neighbourhood : solid::WaveWidth::own)),
      grad(mesh),
      shape(solid.shape),
      held(solid.memory && solid.kinematics != KinematicsKind::left_cauchy_green),
      hold_scratch(mesh),
      pieces(mesh),
      left_out(mesh),
      specks(static_cast<std::size_t>(mesh.n_owned)) {
  hold_parts(physics, patches);
  pieces.find(alpha);
  one_piece = !pieces.several();
  vof::reconstruct(interface, alpha, mesh, reconstruct_scratch, planes());
  const std::vector<char> at_walls = bonded(patches.walls), at_still = bonded(patches.still);
  set_bond(at_walls, at_still);
  set_bond_planes(patches.tight);
  if (solid.trim && filled.clearance < 0) trim_shape(patches.mirrors);
  if (solid.kinematics == KinematicsKind::log_conformation && !patches.walls.empty())
    film.emplace(mesh, patches.walls, at_walls);
  film_thickness = solid.film_thickness;
  alpha_mid.assign(alpha);
  if (held && solid.kinematics == KinematicsKind::log_conformation) {
    memory.emplace(mesh, solid::ReferenceMap::Role::beside_psi, patches.walls, cut);
    memory->hold(at_still);
    memory->set_undeformed(alpha);
  }
  if (auto* map = std::get_if<solid::ReferenceMap>(&kinematics)) map->hold(at_still);
  std::visit([&](auto& k) { k.set_undeformed(alpha); }, kinematics);
  resume();
}

// Later the part that the mesh cut off is not there. The planes of the cut make a valid shape only
// if the solid lies on the same side of each, which the volume tells.
void Body::trim_shape(const std::vector<Patch>& mirrors) {
  constexpr Real same = 1e-4;  // of the volume
  std::vector<Patch> others;
  for (const Patch& patch : mesh.patches)
    if (std::ranges::find(mirrors, patch.name, &Patch::name) == mirrors.end())
      others.push_back(patch);
  const auto planes = vof::cutting_planes(shape, mesh, others).planes;
  const shapes::Shape left = [whole = shape, planes](const Vec3& x) {
    Real value = whole(x);
    for (const geometry::Mirror& plane : planes) value = std::max(value, dot(x - plane.x, plane.n));
    return value;
  };
  CellField<Real> of_left(mesh);
  const Real volume = vof::fill(of_left, mesh, left, mirrors).volume;
  cut_by_mesh = planes.empty() || std::abs(volume - filled.volume) > same * filled.volume;
  if (!cut_by_mesh) shape = left;
}

// In a cell with a corner of the solid the plane may reach a wall that the solid does not. Where
// the wall is curved, the solid may reach the corners of a face but not its centre.
std::vector<char> Body::bonded(const std::vector<Patch>& patches) const {
  constexpr Real touching = 1e-3;  // of a cell
  const auto reached = [&](const Vec3& x, Real within) {
    return std::ranges::any_of(mesh.translation, [&](const Vec3& lap) {
      return shape(x + lap) < within || shape(x - lap) < within;
    });
  };
  const auto at_face = [&](Index f) {
    const Real within = touching * cell_size(mesh, mesh.owner[f]);
    return reached(mesh.Cf[f], within) || std::ranges::any_of(mesh.face_points[f], [&](Index p) {
             return reached(mesh.points[p], within);
           });
  };
  std::vector<char> is(static_cast<std::size_t>(mesh.n_boundary()), 0);
  for (const Patch& patch : patches)
    for (Index f = patch.begin; f < patch.end; ++f)
      is[f - mesh.n_internal] = alpha[mesh.owner[f]] >= solid::alpha_known &&
                                vof::touches(f, alpha, interface, mesh) && at_face(f);
  return is;
}

void Body::set_bond_planes(const std::vector<Patch>& tight) {
  if (!held || bonded_faces + sliding_faces == 0) return;
  const std::vector<char> at_tight = bonded(tight);
  std::vector<Index> faces;
  for (Index b = 0; b < mesh.n_boundary(); ++b)
    if (at_tight[b] != 0 && mesh.owner[mesh.n_internal + b] < mesh.n_owned)
      faces.push_back(mesh.n_internal + b);
  bond_planes.emplace(mesh, faces, solid::Rings::count);
}

void Body::set_bond(const std::vector<char>& at_walls, const std::vector<char>& at_still) {
  std::array<Sum, 2> faces;
  for (Index b = 0; b < mesh.n_boundary(); ++b) {
    if (at_still[b] != 0) bond.push_back(b);
    faces[0].add(at_still[b]), faces[1].add(at_walls[b] - at_still[b]);
  }
  std::array<Real, 2> totals{};
  Sum::totals(totals, faces);
  bonded_faces = static_cast<Index>(totals[0]), sliding_faces = static_cast<Index>(totals[1]);
  for (const Patch& patch : mesh.patches) {
    const auto begin = at_walls.begin() + (patch.begin - mesh.n_internal);
    const bool none =
        std::count(begin, begin + (patch.end - patch.begin), 0) == patch.end - patch.begin;
    stood_on.push_back(all_of_ranks(none) ? 0 : 1);
  }
}

Real Body::bond_kept() const {
  if (bonded_faces == 0) return 1;
  GlobalIndex kept = 0;
  for (const Index b : bond)
    kept += alpha[mesh.owner[mesh.n_internal + b]] >= solid::alpha_known ? 1 : 0;
  return static_cast<Real>(global_sum(kept)) / static_cast<Real>(bonded_faces);
}

void Body::hold_parts(const Physics& physics, const SolidPatches& patches) {
  const std::vector<char> passed = on_faces(patches.openings, mesh);
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
    if (passed[f - mesh.n_internal] != 0) at_openings.push_back(mesh.owner[f]);
  if (!law.B_itself()) T_of_law.emplace(mesh);
  if (std::holds_alternative<solid::LogConformation>(kinematics) && zone.any()) {
    interface_gradient.emplace(
        mesh, zone,
        solid::BoundarySides{.given = on_faces(patches.walls, mesh), .symmetry = mirror});
    kink_profile.emplace(mesh);
  }
  if (extended() && mu != physics.mu_f && physics.mu_f > 0)
    traction.emplace(mesh, weights, G, solid::Viscosities{mu, physics.mu_f}, cut);
  if (weight != Vec3{}) body_force.emplace(mesh, weights, weight);
  if (body_force && rho != physics.rho && weights.uneven) alpha_line.emplace(mesh);
}

void Body::set_B(const std::function<SymTensor(const Vec3&)>& B_0) {
  require(!std::holds_alternative<solid::ReferenceMap>(kinematics),
          "reference_map: B alone does not tell a map; give the map itself");
  std::visit(
      [&](auto& k) {
        if constexpr (requires { k.set(0, SymTensor{}, 0); })
          for (Index c = 0; c < mesh.n_cells; ++c) k.set(c, B_0(mesh.C[c]), alpha[c]);
      },
      kinematics);
  held = false;  // the map from the undeformed shape does not follow from B
  resume();
}

void Body::set_map(const std::function<Vec3(const Vec3&)>& xi_0) {
  auto* map = std::get_if<solid::ReferenceMap>(&kinematics);
  require(map != nullptr, "a map can be given to reference_map only; give B");
  for (Index c = 0; c < mesh.n_cells; ++c) map->set_map(c, xi_0(mesh.C[c]));
  held = false;  // the shape put in is not the undeformed one
  map->hold({});
  resume();
}

void Body::update_B() {
  std::visit(
      [&](auto& k) {
        band.rebuild(alpha, k.alpha_min);
        for (const Index c : last_cells) B[c] = {}, lambda[c] = 0, normal[c] = {};
        if (T_of_law)
          for (const Index c : last_cells) (*T_of_law)[c] = {};
        last_cells = band.cells();
        eigenvalue_min = k.update_B(B, lambda, alpha, band);
      },
      kinematics);
  if (T_of_law) {
    const bool within = law.apply({*T_of_law, lambda, B, alpha, band.cells(), solid::alpha_known});
    beyond_law = !all_of_ranks(within);
    if (beyond_law)
      throw Error(ErrorKind::numerics, "the solid is strained beyond its law, " + law.name());
    mesh.halo.update(*T_of_law, band.listed());
  }
  if (extended()) {
    vof::face_fraction(alpha_f, alpha, interface, weights, mesh, band.faces(),
                       reconstruct_scratch.symmetry);
    vof::cell_plane(normal, height, alpha, interface, mesh, band.cells());
    mesh.halo.update(normal, band.listed());
    vof::face_normal(normal_f, normal, mesh, band.faces(), reconstruct_scratch.symmetry);
  } else {
    vof::mean_fraction(alpha_f, alpha, weights, mesh, band.faces());
  }
  if (alpha_line) vof::line_fraction(*alpha_line, alpha, interface, weights, mesh, band.faces());
  mesh.halo.update(B, band.listed());
  mesh.halo.update(lambda, band.listed());
}

void Body::find_strays() {
  const solid::ReferenceMap& m = *map();
  // Around a crumb that was torn off the map tells that the solid goes on. There the rule would
  // build the whole solid anew.
  pieces.find(m.filled());
  const bool several = pieces.several();
  if (several) pieces.mark_crumbs(left_out, m.filled(), solid::Rings::count);
  const auto of_piece = [&](Index n) { return alpha[n] >= solid::alpha_known && left_out[n] == 0; };
  trust.clear(), strays.clear();
  for (const Index c : m.cells()) {
    const bool at_crumb = several && left_out[c] > 0;
    trust.push_back(at_crumb ? 0 : m.trust(c));
    if (one_piece && at_crumb && alpha[c] > 0 &&
        std::ranges::none_of(mesh.cell_neighbours[c], of_piece))
      strays.push_back(c);
  }
  for (const Index c : band.cells())
    if (one_piece && alpha[c] > 0 && m.is_set[c] == 0) strays.push_back(c);
}

void Body::hold_shape() {
  if (!held || gone != 0) return;
  const solid::ReferenceMap& m = *map();
  find_strays();
  vof::ShapeMap shape_map{.shape = shape,
                          .d = m.d,
                          .gradient = m.slope(),
                          .cells = m.cells(),
                          .weight = trust,
                          .bond = bond_planes ? &*bond_planes : nullptr};
  // It would do so where an opening or the mesh has cut the solid, too.
  if (volume_out > rounding_out * filled.volume || cut_by_mesh) {
    vof::mark_cut(left_out, alpha, shape_map, mesh, solid::Rings::count, at_openings);
    for (std::size_t i = 0; i < trust.size(); ++i)
      if (left_out[m.cells()[i]] > 0) trust[i] = 0;
    std::erase_if(strays, [&](Index c) { return left_out[c] > 0; });
  }
  shape_map.strays = strays;
  const vof::Held done = vof::hold_shape(alpha, shape_map, mesh, hold_scratch);
  shape_moved = done.moved, volume_returned += done.returned;
  vof::reconstruct(interface, alpha, mesh, reconstruct_scratch);
}

void Body::set_touched(std::span<const Index> cells, std::span<const char> open) {
  for (const Index c : cells)
    for (const Index f : mesh.cell_faces[c]) {
      if (f < mesh.n_internal) continue;
      const Index b = f - mesh.n_internal;
      touched[b] = open[b] == 0 && vof::touches(f, alpha, interface, mesh) ? 1 : 0;
    }
}

bool Body::count_out() {
  constexpr Real speck = 0.01, rest = 0.01;
  Sum out;
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) out.add(advect_scratch.solid[f]);
  volume_out += out.total();
  if (volume_out <= rounding_out * filled.volume || gone != 0) return false;
  Sum left, taken, half_solid;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    specks[c] = 0;
    if (alpha[c] >= solid::alpha_known) half_solid.add(1);
    if (alpha[c] == 0) continue;
    Real most = alpha[c];
    for (const Index n : mesh.cell_neighbours[c]) most = std::max(most, alpha[n]);
    const bool out_of_it = most < speck;
    specks[c] = out_of_it ? 1 : 0;
    (out_of_it ? taken : left).add(mesh.V[c] * alpha[c]);
  }
  std::array<Real, 3> total{};
  Sum::totals(total, std::array{left, taken, half_solid});
  const bool all = total[0] < rest * filled.volume || total[2] == 0;
  if (!all && total[1] == 0) return false;
  volume_out += total[1] + (all ? total[0] : 0);
  gone = all ? 1 : 0, residue = all ? total[0] + total[1] : 0;
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (all || specks[c] != 0) alpha[c] = 0;
  mesh.halo.update(alpha);
  return true;
}

void Body::list(io::Snapshot& snapshot) {
  const std::string of = name.empty() ? "" : name + "_";
  snapshot.add(of + "alpha", alpha);
  if (strain_by_flux()) snapshot.add(of + "alpha_mid", alpha_mid);
  snapshot.add(of + "solid_t", &t);
  snapshot.add(of + "solid_begun", &begun);
  snapshot.add_optional(of + "solid_t_begun", &t_begun);
  snapshot.add(of + "solid_volume_out", &volume_out);
  snapshot.add(of + "solid_gone", &gone);
  snapshot.add(of + "solid_residue", &residue);
  snapshot.add_optional(of + "solid_volume_returned", &volume_returned);
  snapshot.add(of + "solid_strain_rate", &strain.rate);
  if (auto* k = std::get_if<solid::LeftCauchyGreen>(&kinematics)) snapshot.add(of + "Bt", k->Bt);
  if (auto* k = std::get_if<solid::LogConformation>(&kinematics)) snapshot.add(of + "psi", k->psi);
  auto* map = memory ? &*memory : std::get_if<solid::ReferenceMap>(&kinematics);
  if (map != nullptr) {
    snapshot.add(of + "map", map->d);
    snapshot.add(of + "map_is_set", map->is_set);
  }
}

void Body::resume() {
  vof::reconstruct(interface, alpha, mesh, reconstruct_scratch, planes());
  if (remembers()) memory->resume(alpha, grad);
  if (film) film->set(fraction_of_strain());
  std::visit([&](auto& k) { k.resume(strain_fraction(), grad); }, kinematics);
  update_B();
}

}  // namespace fsi
