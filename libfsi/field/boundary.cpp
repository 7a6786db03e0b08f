#include "libfsi/field/boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"

namespace fsi {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

std::string names(const Mesh& mesh) {
  std::string list;
  for (const Patch& patch : mesh.patches) list += (list.empty() ? "" : ", ") + patch.name;
  return list;
}

std::string names(const Conditions& conditions) {
  std::string list;
  for (const auto& item : conditions) list += (list.empty() ? "" : ", ") + item.first;
  return list;
}

/// A moving wall may slide only: largest part of its velocity through a face.
void require_sliding(const Wall& wall, const Patch& patch, const Mesh& mesh) {
  constexpr Real tolerance = 1e-6;
  Real through = 0;
  for (Index f = patch.begin; f < patch.end; ++f)
    through = std::max(through, std::abs(dot(wall.velocity, mesh.Sf[f])) / norm(mesh.Sf[f]));
  require(global_max(through) <= tolerance * norm(wall.velocity),
          "patch \"" + patch.name +
              "\" moves through itself: a wall with a velocity slides in its " +
              "own plane or along a cylinder's axis; give the velocity of its faces instead");
}

/// In two dimensions nothing moves out of the plane.
void require_plane(const BoundaryField<Vec3>& u_b, const Mesh& mesh) {
  for (const Patch& patch : mesh.patches) {
    bool plane = true;
    for (Index f = patch.begin; f < patch.end; ++f)
      plane = plane && (mesh.dim == 3 || u_b[f - mesh.n_internal].z == 0);
    require(all_of_ranks(plane), "the velocity of patch \"" + patch.name +
                                     "\" has a part along z, but a mesh of two dimensions lies in "
                                     "the x-y plane, and nothing moves out of it");
  }
}

void require_passive(const Load& load, const std::string& patch) {
  require(load.proximal >= 0 && load.distal >= 0 && load.capacitance >= 0,
          "patch \"" + patch + "\": resistances and capacitance of a load must be >= 0");
  require(load.capacitance == 0 || load.distal > 0,
          "patch \"" + patch + "\": a capacitance needs a distal resistance > 0 beside it");
}

/// Whether a function that the condition needs is none.
bool empty(const Condition& condition) {
  const auto* fixed = std::get_if<FixedVelocity>(&condition);
  const auto* flow = std::get_if<FlowRate>(&condition);
  const auto* opening = std::get_if<Opening>(&condition);
  return (fixed != nullptr && !fixed->u) || (flow != nullptr && !flow->rate.any()) ||
         (opening != nullptr && !opening->pressure.any());
}

void set_shapes(std::vector<Condition>& conditions, const Mesh& mesh) {
  std::vector<Patch> free;
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (lets_slip(conditions[i])) free.push_back(mesh.patches[i]);
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (auto* flow = std::get_if<FlowRate>(&conditions[i]))
      flow->shape = inflow_shape(flow->profile, mesh.patches[i], mesh, free);
}

}  // namespace

std::vector<Condition> resolve(const Conditions& conditions, const Mesh& mesh) {
  std::vector<Condition> result;
  for (const Patch& patch : mesh.patches) {
    const auto found = conditions.find(patch.name);
    require(found != conditions.end(),
            "patch \"" + patch.name + "\" of the mesh has no boundary condition in this driver, " +
                "which knows: " + names(conditions) + "; rename it or join it by -mesh_periodic");
    result.push_back(found->second);
    require(!empty(found->second), "what is given at patch \"" + patch.name + "\" is empty");
    if (const auto* wall = std::get_if<Wall>(&found->second)) require_sliding(*wall, patch, mesh);
    if (const auto* opening = std::get_if<Opening>(&found->second))
      require_passive(opening->load, patch.name);
  }
  for (const auto& [name, condition] : conditions) {
    bool there = false;
    for (const Patch& patch : mesh.patches) there = there || patch.name == name;
    require(there, "patch \"" + name + "\" is not in the mesh, " +
                       (mesh.patches.empty() ? "of which all patches are periodic"
                                             : "which has: " + names(mesh)));
  }
  set_shapes(result, mesh);
  BoundaryField<Vec3> u_b(mesh);
  set_boundary_velocity(u_b, CellField<Vec3>(mesh), result, 0, mesh);
  Real passed = 0, sum = 0;
  for (Index b = 0; b < mesh.n_boundary(); ++b) sum += norm2(u_b[b]);
  require(all_of_ranks(std::isfinite(sum)), "at t = 0 what is given at the patches is not finite");
  require_plane(u_b, mesh);
  const std::string excess = imbalance(passed, u_b, result, mesh);
  require(excess.empty(), "at t = 0 " + excess);
  return result;
}

std::string imbalance(Real& passed, const BoundaryField<Vec3>& u_b,
                      const std::vector<Condition>& conditions, const Mesh& mesh) {
  if (std::ranges::any_of(conditions, fixes_pressure)) return "";
  std::array<Sum, 3> sums;  // of the flow out, of its amount, of the speed over the faces
  Real tolerance = 1e-3;    // of rates that are given as such, by tables
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (!prescribes_flow(conditions[i])) continue;
    constexpr Real sampled = 0.02;  // of a velocity in the middle of faces
    if (std::holds_alternative<FixedVelocity>(conditions[i])) tolerance = sampled;
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Vec3& u = u_b[f - mesh.n_internal];
      const Real flux = dot(u, mesh.Sf[f]);
      sums[0].add(flux), sums[1].add(std::abs(flux)), sums[2].add(norm(u) * norm(mesh.Sf[f]));
    }
  }
  std::array<Real, 3> total{};
  Sum::totals(total, sums);
  if (!std::isfinite(total[2])) return "";
  // What slides along a curved patch passes its flat faces by a little.
  constexpr Real sliding = 0.05;
  const Real net = total[0];
  passed = std::max({passed, total[1], sliding * total[2]});
  if (std::abs(net) <= tolerance * passed) return "";
  return print("%.4g more flows %s through the patches per unit of time, where %.4g flows %s, ",
               std::abs(net), net < 0 ? "in" : "out", (total[1] + std::abs(net)) / 2,
               net < 0 ? "in" : "out") +
         "and no patch gives the pressure: make one of them an opening, or let both be equal";
}

bool has_openings(const Conditions& conditions) {
  return std::ranges::any_of(conditions, [](const auto& item) {
    return fixes_pressure(item.second) || prescribes_flow(item.second);
  });
}

void set_boundary_velocity(BoundaryField<Vec3>& u_b, const CellField<Vec3>& u,
                           const std::vector<Condition>& conditions, Real t, const Mesh& mesh) {
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Index begin = mesh.patches[i].begin, end = mesh.patches[i].end;
    const auto set = [&](auto&& value) {
      for (Index f = begin; f < end; ++f) u_b[f - mesh.n_internal] = value(f, u[mesh.owner[f]]);
    };
    std::visit(
        Overloaded{[&](const Wall& wall) {
                     set([&](Index f,
                             const Vec3&) {  // exactly along the face, as no flow goes through
                       const Vec3& S = mesh.Sf[f];
                       return wall.velocity - (dot(wall.velocity, S) / norm2(S)) * S;
                     });
                   },
                   [&](const Slip&) {
                     set([&](Index f, const Vec3& u_P) {  // u_b = u_P - (u_P . n) n
                       return u_P - (dot(u_P, mesh.Sf[f]) / norm2(mesh.Sf[f])) * mesh.Sf[f];
                     });
                   },
                   [&](const FixedVelocity& fixed) {
                     set([&](Index f, const Vec3&) { return fixed.u(mesh.Cf[f], t); });
                   },
                   [&](const FlowRate& flow) {
                     const Real rate = flow.rate(t);
                     set([&](Index f, const Vec3&) { return rate * flow.shape[f - begin]; });
                   },
                   [&](const Opening&) { set([&](Index, const Vec3& u_P) { return u_P; }); }},
        conditions[i]);
  }
}

Real conditions_dt(const std::vector<Condition>& conditions, Real t, Real end) {
  Real least = end;
  const auto follow = [&](const OfTime& given) { least = std::min(least, step_of(given, t, end)); };
  for (const Condition& condition : conditions)
    std::visit(
        Overloaded{[&](const FixedVelocity& inflow) {
                     if (inflow.pace.any()) follow(inflow.pace);
                   },
                   [&](const FlowRate& inflow) { follow(inflow.rate); },
                   [&](const Opening& opening) { follow(opening.pressure); }, [](const auto&) {}},
        condition);
  return least;
}

bool fixes_velocity(const Condition& condition) {
  return std::holds_alternative<Wall>(condition) || prescribes_flow(condition);
}

bool prescribes_flow(const Condition& condition) {
  return std::holds_alternative<FixedVelocity>(condition) ||
         std::holds_alternative<FlowRate>(condition);
}

bool fixes_pressure(const Condition& condition) {
  return std::holds_alternative<Opening>(condition);
}

bool lets_slip(const Condition& condition) { return std::holds_alternative<Slip>(condition); }

std::vector<bool> patches_where(const std::vector<Condition>& conditions,
                                bool (*holds)(const Condition&)) {
  std::vector<bool> where;
  for (const Condition& condition : conditions) where.push_back(holds(condition));
  return where;
}

std::vector<char> faces_where(const std::vector<Condition>& conditions, const Mesh& mesh,
                              bool (*holds)(const Condition&)) {
  std::vector<char> where(static_cast<std::size_t>(mesh.n_boundary()), 0);
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (holds(conditions[i]))
      for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f)
        where[f - mesh.n_internal] = 1;
  return where;
}

}  // namespace fsi
