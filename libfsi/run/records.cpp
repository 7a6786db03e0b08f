#include "libfsi/run/records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

#include "libfsi/analysis/measures.hpp"
#include "libfsi/analysis/ring.hpp"
#include "libfsi/analysis/surface.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/flow/planes_at.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/operators/pieces.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/run/taylor.hpp"
#include "libfsi/solver/energy.hpp"

namespace fsi {
namespace {

const Patch* find(const Mesh& mesh, const std::string& name) {
  const auto at = std::ranges::find(mesh.patches, name, &Patch::name);
  return at == mesh.patches.end() ? nullptr : &*at;
}

/// The mean over those vertex neighbours of cell c that count, identity without one.
SymTensor mean_around(const CellField<SymTensor>& B, const std::function<bool(Index)>& counts,
                      const Mesh& mesh, Index c) {
  SymTensor sum;
  Real count = 0;
  for_vertex_neighbours(c, mesh, [&](Index n, const Vec3&) {
    if (counts(n)) sum += B[n], ++count;
  });
  return count > 0 ? (1 / count) * sum : identity();
}

/// Length of a periodic channel along its axis; 0 where the mesh has no period along it.
Real period(const Solver& solver) {
  Real length = 0;
  for (const Vec3& translation : solver.mesh().translation)
    length = std::max(length, std::abs(dot(translation, solver.axis())));
  return length;
}

Real flow_rate(const Solver& solver, const Patch& patch) {
  Sum sum;
  for (Index f = patch.begin; f < patch.end; ++f) sum.add(solver.state().phi[f]);
  return sum.total();
}

Real flow_rate(const Solver& solver, Real mean_velocity) {
  const Mesh& mesh = solver.mesh();
  const Real length = period(solver);
  if (length > 0) return mean_velocity * mesh.total_volume / length;
  const Patch* outlet = find(mesh, "outlet");
  if (outlet == nullptr) return 0;
  return flow_rate(solver, *outlet);
}

Real mean_pressure(const Solver& solver, const Patch& patch) {
  const Mesh& mesh = solver.mesh();
  Sum p, area;
  for (Index f = patch.begin; f < patch.end; ++f) {
    const Real size = norm(mesh.Sf[f]);
    p.add(size * solver.p_b()[f - mesh.n_internal]), area.add(size);
  }
  return p.total() / area.total();
}

Real mean_pressure_beside(const Solver& solver, const Patch& patch) {
  const Mesh& mesh = solver.mesh();
  Sum p;
  for (Index f = patch.begin; f < patch.end; ++f)
    p.add(norm(mesh.Sf[f]) * solver.state().p[mesh.owner[f]]);
  return p.total() / area_of(patch, mesh).size;
}

Real pressure_drop(const Solver& solver) {
  const Patch *inlet = find(solver.mesh(), "inlet"), *outlet = find(solver.mesh(), "outlet");
  if (inlet == nullptr || outlet == nullptr) return solver.driving_gradient() * period(solver);
  const auto pressure = [&](const Patch& patch) {
    const Condition& condition = solver.conditions()[&patch - solver.mesh().patches.data()];
    return fixes_pressure(condition) ? mean_pressure(solver, patch)
                                     : mean_pressure_beside(solver, patch);
  };
  return pressure(*inlet) - pressure(*outlet);
}

/// Columns of each patch that fluid goes through, and the largest Reynolds number there.
void add_openings(std::vector<Entry>& row, const Solver& solver,
                  const std::vector<Real>& diameters) {
  const Mesh& mesh = solver.mesh();
  Real velocity_length = 0;
  bool any = false;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i) {
    const Patch& patch = mesh.patches[i];
    const Condition& condition = solver.conditions()[i];
    const bool open = fixes_pressure(condition);
    if (!open && !prescribes_flow(condition)) continue;
    any = true;
    const Real Q = flow_rate(solver, patch), A = area_of(patch, mesh).size;
    row.push_back({"flow_rate_" + patch.name, Q});
    row.push_back({"mean_pressure_" + patch.name,
                   open ? solver.opening_pressure(patch.name) : mean_pressure_beside(solver, patch),
                   Course::pressure});
    velocity_length = std::max(velocity_length, std::abs(Q) / A * diameters[i]);
  }
  if (any)
    row.push_back({"reynolds", solver.physics().rho * velocity_length / solver.physics().mu_f});
}

/// 0 where no cell is without solid.
Real pressure_span(const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  Real low = std::numeric_limits<Real>::max(), high = -low;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (std::ranges::any_of(solver.bodies(), [c](const Body& body) { return body.alpha[c] > 0; }))
      continue;
    low = std::min(low, solver.state().p[c]), high = std::max(high, solver.state().p[c]);
  }
  return std::max(global_max(high) - global_min(low), Real{0});
}

void add(std::vector<Entry>& row, const std::vector<std::string>& columns, const Vec3& v,
         Course course = Course::smooth) {
  for (int i = 0; i < 3; ++i) row.push_back({columns[static_cast<std::size_t>(i)], v[i], course});
}

Real aspect(const analysis::Ellipse& e) { return e.aspect(); }

void add_ring(std::vector<Entry>& row, const analysis::Ring& ring) {
  row.push_back({"aspect_forward", aspect(ring.forward)});
  row.push_back({"aspect_back", aspect(ring.back)});
  row.push_back({"aspect_right", aspect(ring.right)});
  row.push_back({"aspect_left", aspect(ring.left)});
  row.push_back({"aspect_inner", aspect(ring.inner)});
  row.push_back({"aspect_outer", aspect(ring.outer)});
  row.push_back({"bending_meridian", ring.bending_meridian});
  row.push_back({"bending_prime", ring.bending_prime});
}

/// Extremes of J = det grad xi in cells with alpha of at least 1/2: the error of volume of the map.
void set_map(Soundness& soundness, const solid::ReferenceMap& map, const Body& body) {
  Real low = std::numeric_limits<Real>::max(), high = -low;
  for (Index c = 0; c < body.mesh.n_owned; ++c) {
    if (!(body.alpha[c] >= solid::alpha_known)) continue;
    low = std::min(low, map.volume_ratio(c)), high = std::max(high, map.volume_ratio(c));
  }
  low = global_min(low), high = global_max(high);
  if (low <= high) soundness.map_det_min = low, soundness.map_det_max = high;
}

void add_map(std::vector<Entry>& row, const Soundness& soundness, const Body& body) {
  row.push_back({"map_det_min", soundness.map_det_min});
  row.push_back({"map_det_max", soundness.map_det_max});
  row.push_back({"shape_energy", soundness.shape_energy, Course::energy});
  row.push_back({"shape_moved", body.shape_moved, Course::step});
  row.push_back({"volume_returned", body.volume_returned});
}

/// Number of a limit in flow.csv.
Real limit_code(const std::string& name) {
  constexpr std::array<std::string_view, 11> names{"none",   "fixed",      "advective", "elastic",
                                                   "start",  "step_max",   "event",     "retry",
                                                   "strain", "conditions", "end"};
  const auto at = std::ranges::find(names, name);
  FSI_ASSERT(at != names.end());
  return static_cast<Real>(at - names.begin());
}

}  // namespace

Real dissipation(Solver& solver) {
  const Mesh& mesh = solver.mesh();
  const Real mu_f = solver.physics().mu_f;
  CellField<Real> mu(mesh, mu_f);
  Sum of_solids;
  for (const Body& body : solver.bodies())
    for (Index c = 0; c < mesh.n_owned; ++c) {
      const Tensor* own = body.traction ? body.traction->own_gradient(c) : nullptr;
      const Real part = body.alpha[c];
      mu[c] += part * ((own != nullptr ? 0 : body.mu) - mu_f);
      if (own != nullptr)
        of_solids.add(part * body.mu * mesh.V[c] * analysis::twice_strain_squared(*own));
    }
  return of_solids.total() + analysis::dissipation(mu, solver.velocity_gradient(), mesh);
}

std::vector<std::string> names(const std::vector<Entry>& row) {
  std::vector<std::string> result;
  for (const Entry& entry : row) result.push_back(entry.name);
  return result;
}

std::vector<Real> values(const std::vector<Entry>& row) {
  std::vector<Real> result;
  for (const Entry& entry : row) result.push_back(entry.value);
  return result;
}

Real surface_area(const Body& body) {
  Sum area;
  for (const Index c : body.interface.cells) area.add(body.interface.piece[c].area);
  // Between a full and an empty cell the face itself is the surface.
  const Mesh& mesh = body.mesh;
  const auto whole = [&](Index c) { return body.interface.piece[c].area == 0; };
  for (const Index f : body.band.faces()) {
    if (f >= mesh.n_internal || mesh.owner[f] >= mesh.n_owned) continue;
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    if (whole(P) && whole(N) && std::abs(body.alpha[P] - body.alpha[N]) > 0.5)
      area.add(norm(mesh.Sf[f]));
  }
  return area.total();
}

Real shape_energy(const Body& body) {
  const solid::ReferenceMap* map = body.map();
  if (map == nullptr) return 0;
  const Mesh& mesh = body.mesh;
  const CellField<Real>& alpha = body.alpha;
  // A crumb that was torn off has no map of its own shape.
  CellField<Real> crumbs(mesh);
  Pieces pieces(mesh);
  pieces.find(alpha);
  if (pieces.several()) pieces.mark_crumbs(crumbs, alpha, solid::Rings::count);
  const auto has_map = [&](Index c) { return map->is_set[c] > 0 && crumbs[c] == 0; };
  const auto mapped = [&](Index c) { return alpha[c] >= solid::alpha_known && has_map(c); };
  CellField<SymTensor> B(mesh, identity());
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (mapped(c)) B[c] = map->B(c, alpha[c]);
  mesh.halo.update(B);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (mapped(c) || !has_map(c) || !(alpha[c] > 0)) continue;
    // Where the extrapolated map is wrong in volume by a factor of two and more, it says nothing.
    B[c] = map->trust(c) > 0 ? map->B(c, alpha[c]) : mean_around(B, mapped, mesh, c);
  }
  return body.law.energy(body.G, B, alpha, mesh);
}

std::vector<Real> whole_diameters(const Solver& solver) {
  const Mesh& mesh = solver.mesh();
  std::vector<Patch> mirrors;
  for (std::size_t i = 0; i < mesh.patches.size(); ++i)
    if (lets_slip(solver.conditions()[i])) mirrors.push_back(mesh.patches[i]);
  std::vector<Real> diameters;
  for (const Patch& patch : mesh.patches)
    diameters.push_back(flow::whole_diameter(patch, mirrors, mesh));
  return diameters;
}

std::vector<Entry> flow_row(Solver& solver, const std::vector<Real>& diameters, Real elastic_energy,
                            const Limit& limit, Real dt, Real wall_per_step) {
  const Mesh& mesh = solver.mesh();
  const Real mean_velocity = solver.mean_velocity();
  std::vector<Entry> row{
      {"t", solver.state().t},
      {"dt", dt, Course::step},
      {"dt_limit", limit.dt, Course::step},
      {"limit", limit_code(limit.name), Course::step},
      {"courant", dt / solver.advective_dt(1), Course::step},
      {"pressure_gradient", solver.driving_gradient(), Course::pressure},
      {"pressure_drop", pressure_drop(solver), Course::pressure},
      {"pressure_span", pressure_span(solver), Course::pressure},
      {"flow_rate", flow_rate(solver, mean_velocity)},
      {"mean_velocity", mean_velocity},
      {"divergence_max", flow::divergence_max(solver.state().phi, mesh), Course::step},
      {"kinetic_energy", kinetic_energy(solver)},
      {"elastic_energy", elastic_energy, Course::energy},
      {"dissipation", dissipation(solver)},
      {"rejected_steps", static_cast<Real>(solver.report().rejected), Course::step},
      {"pressure_iterations", static_cast<Real>(solver.report().pressure_iterations), Course::step},
      {"wall_per_step", wall_per_step, Course::step}};
  if (solver.bodies().size() > 1) row.push_back({"overlap", solver.overlap(), Course::step});
  add_openings(row, solver, diameters);
  return row;
}

std::vector<Entry> SolidRecord::row(const Solver& solver, const Body& body) {
  const Mesh& mesh = solver.mesh();
  tracker_.started = started_ != 0;
  const Real ahead = solver.state().t - body.t;
  const analysis::Motion m = analysis::motion(tracker_, body.alpha, solver.state().u, mesh, ahead);
  started_ = tracker_.started ? 1 : 0;
  const std::vector<geometry::Mirror>& mirrors = body.filled.cut_by.planes;
  const analysis::Surface surface = analysis::isosurface(body.alpha, mesh, tracker_.home, mirrors);
  const analysis::Surface whole = analysis::with_images(surface, mirrors);
  Vec3 middle = tracker_.home;  // of the whole solid
  for (const geometry::Mirror& mirror : mirrors) middle = mirror.foot(middle);
  const analysis::Orientation o = analysis::orientation(whole, middle, orientation_);
  // The axis of revolution is the direction apart from the other two: the longest of a rod.
  if (rod_ < 0) rod_ = mesh.dim == 3 && o.value[2] - o.value[1] > o.value[1] - o.value[0] ? 1 : 0;
  turned_ += rod_ == 1 ? analysis::turn_about_z(orientation_.longest, o.longest)
                       : analysis::turn_about_z(orientation_.n, o.n);
  orientation_ = o;
  CellField<SymTensor> B = B_field(body, mesh);
  const analysis::Health h = analysis::health(B, body.alpha, mesh);
  if (volume_0_ == 0) volume_0_ = m.volume + body.volume_out;
  drift_ = (m.volume + body.volume_out) / volume_0_ - 1;
  constexpr Real piece = 0.01;  // of the first volume: smaller ones are not counted
  Pieces pieces(mesh);
  pieces.find(body.alpha);
  soundness_ = {.eigenvalue_min = h.eigenvalue_min,
                .pieces = pieces.count(body.alpha, piece * volume_0_),
                .elastic_energy = elastic_energy(body, std::move(B)),
                .shape_energy = shape_energy(body),
                .bond_kept = body.bond_kept()};
  std::vector<Entry> row{{"t", solver.state().t}};
  add(row, {"x", "y", "z"}, m.centroid + ahead * m.velocity);
  add(row, {"ux", "uy", "uz"}, m.velocity);
  row.push_back({"volume", m.volume});
  row.push_back({"volume_out", body.volume_out});
  add(row, {"nx", "ny", "nz"}, o.n, Course::shape);
  row.push_back({"angle", analysis::angle_to_x(o.n), Course::shape});
  row.push_back({"turned", turned_, Course::shape});
  add(row, {"lx", "ly", "lz"}, o.longest, Course::shape);
  row.push_back({"long_angle", analysis::angle_to_x(o.longest), Course::shape});
  row.push_back({"area", surface_area(body), Course::shape});
  row.push_back({"det_B_min", h.det_min});
  row.push_back({"det_B_max", h.det_max});
  row.push_back({"min_eig_B", h.eigenvalue_min});
  row.push_back({"pieces", static_cast<Real>(soundness_.pieces), Course::step});
  row.push_back({"overshoot", body.advected.remaining, Course::step});
  const Taylor shape = taylor(body, solver.state().u, tracker_.home, ahead);
  row.push_back({"taylor", shape.deformation});
  row.push_back({"taylor_angle", shape.angle, Course::half_turn});
  row.push_back({"elastic_energy", soundness_.elastic_energy, Course::energy});
  if (body.map() != nullptr) {
    set_map(soundness_, *body.map(), body);
    add_map(row, soundness_, body);
  }
  if (!ring_ || mesh.dim == 2) return row;
  const analysis::RingFrame frame = analysis::ring_frame(o.n, zeta_);
  zeta_ = frame.zeta;
  add_ring(row, analysis::ring(whole, middle, frame));
  return row;
}

void SolidRecord::list(io::Snapshot& snapshot, const std::string& name) {
  const std::string of = name.empty() ? "" : name + "_";
  const auto add_vector = [&](const std::string& what, Vec3& v) {
    snapshot.add(of + what + "_x", &v.x);
    snapshot.add(of + what + "_y", &v.y);
    snapshot.add(of + what + "_z", &v.z);
  };
  add_vector("tracker_home", tracker_.home);
  add_vector("tracker_travelled", tracker_.travelled);
  add_vector("tracker_middle", tracker_.middle);
  add_vector("axis", orientation_.n);
  add_vector("longest", orientation_.longest);
  add_vector("zeta", zeta_);
  snapshot.add(of + "tracker_started", &started_);
  snapshot.add(of + "turned", &turned_);
  snapshot.add_optional(of + "rod", &rod_);
  snapshot.add(of + "volume_0", &volume_0_);
  snapshot.add(of + "drift", &drift_);
}

Real largest_drift(const std::vector<SolidRecord>& records) {
  Real most = 0;
  for (const SolidRecord& record : records)
    if (std::abs(record.drift()) > std::abs(most)) most = record.drift();
  return most;
}

}  // namespace fsi
