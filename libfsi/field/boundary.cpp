#include "libfsi/field/boundary.hpp"

#include "libfsi/core/error.hpp"

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

}  // namespace

std::vector<Condition> resolve(const Conditions& conditions, const Mesh& mesh) {
  std::vector<Condition> result;
  for (const Patch& patch : mesh.patches) {
    const auto found = conditions.find(patch.name);
    require(found != conditions.end(),
            "patch \"" + patch.name + "\" of the mesh has no boundary condition in this driver, " +
                "which knows: " + names(conditions) + "; rename it or join it by -mesh_periodic");
    result.push_back(found->second);
  }
  for (const auto& [name, condition] : conditions) {
    bool there = false;
    for (const Patch& patch : mesh.patches) there = there || patch.name == name;
    require(there, "patch \"" + name + "\" is not in the mesh, which has: " + names(mesh));
  }
  return result;
}

void set_boundary_velocity(BoundaryField<Vec3>& u_b, const CellField<Vec3>& u,
                           const std::vector<Condition>& conditions, Real t, const Mesh& mesh) {
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Index begin = mesh.patches[i].begin, end = mesh.patches[i].end;
    const auto set = [&](auto&& value) {
      for (Index f = begin; f < end; ++f) u_b[f - mesh.n_internal] = value(f, u[mesh.owner[f]]);
    };
    std::visit(
        Overloaded{
            [&](const Wall& wall) { set([&](Index, const Vec3&) { return wall.velocity; }); },
            [&](const Slip&) {
              set([&](Index f, const Vec3& u_P) {  // u_b = u_P - (u_P . n) n
                return u_P - (dot(u_P, mesh.Sf[f]) / norm2(mesh.Sf[f])) * mesh.Sf[f];
              });
            },
            [&](const FixedVelocity& fixed) {
              set([&](Index f, const Vec3&) { return fixed.u(mesh.Cf[f], t); });
            },
            [&](const Opening&) { set([&](Index, const Vec3& u_P) { return u_P; }); }},
        conditions[i]);
  }
}

void set_boundary_pressure(BoundaryField<Real>& p_b, const std::vector<Condition>& conditions,
                           const Mesh& mesh) {
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (const auto* opening = std::get_if<Opening>(&conditions[i]))
      for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f)
        p_b[f - mesh.n_internal] = opening->pressure;
}

bool fixes_velocity(const Condition& condition) {
  return std::holds_alternative<Wall>(condition) ||
         std::holds_alternative<FixedVelocity>(condition);
}

bool fixes_pressure(const Condition& condition) {
  return std::holds_alternative<Opening>(condition);
}

}  // namespace fsi
