#include "libfsi/solver/body.hpp"

#include "libfsi/core/error.hpp"

namespace fsi {
namespace {

Kinematics make(const Mesh& mesh, KinematicsKind kind) {
  if (kind == KinematicsKind::left_cauchy_green) return solid::LeftCauchyGreen(mesh);
  if (kind == KinematicsKind::reference_map) return solid::ReferenceMap(mesh);
  return solid::LogConformation(mesh);
}

}  // namespace

Body::Body(const Mesh& mesh_, const FaceWeights& weights_, const shapes::Shape& shape, Real G,
           KinematicsKind kind)
    : mesh(mesh_),
      weights(weights_),
      alpha(mesh),
      alpha_mid(mesh),
      B(mesh),
      alpha_f(mesh),
      normal_f(mesh),
      lambda(mesh),
      touched(mesh),
      interface(mesh),
      reconstruct_scratch(mesh),
      advect_scratch(mesh),
      band(mesh),
      kinematics(make(mesh, kind)),
      law(mesh, weights, G),
      stiffness(mesh),
      grad(mesh),
      filled(vof::fill(alpha, mesh, shape)) {
  if (kind == KinematicsKind::log_conformation && solid::has_simplices(mesh))
    sided.emplace(mesh), reach.emplace(mesh);
  alpha_mid.assign(alpha);
  std::visit([&](auto& k) { k.set_undeformed(alpha); }, kinematics);
  resume();
}

void Body::set_B(const std::function<SymTensor(const Vec3&)>& B_0) {
  std::visit(
      [&](auto& k) {
        for (Index c = 0; c < mesh.n_cells; ++c) k.set(c, B_0(mesh.C[c]), alpha[c]);
      },
      kinematics);
  resume();
}

void Body::set_map(const std::function<Vec3(const Vec3&)>& xi_0) {
  auto* map = std::get_if<solid::ReferenceMap>(&kinematics);
  require(map != nullptr, "a map can be given to reference_map only; give B");
  for (Index c = 0; c < mesh.n_cells; ++c) map->set_map(c, xi_0(mesh.C[c]));
  resume();
}

void Body::weigh() {
  std::visit(
      [&](auto& k) {
        band.rebuild(alpha, k.alpha_min);
        for (const Index c : last_cells) B[c] = {}, lambda[c] = 0;
        last_cells = band.cells();
        eigenvalue_min = k.weigh(B, lambda, alpha, band);
      },
      kinematics);
  if (extended()) {
    vof::face_fraction(alpha_f, alpha, interface, weights, mesh, band.faces());
    vof::face_normal(normal_f, alpha, interface, mesh, band.faces());
  } else {
    vof::mean_fraction(alpha_f, alpha, weights, mesh, band.faces());
  }
  mesh.halo.update(B, band.listed());
  mesh.halo.update(lambda, band.listed());
}

void Body::set_touched(std::span<const Index> cells, std::span<const char> open) {
  for (const Index c : cells)
    for (const Index f : mesh.cell_faces[c]) {
      if (f < mesh.n_internal) continue;
      const Index b = f - mesh.n_internal;
      touched[b] = open[b] == 0 && vof::touches(f, alpha, interface, mesh) ? 1 : 0;
    }
}

void Body::list(io::Snapshot& snapshot) {
  snapshot.add("alpha", alpha);
  if (strained_by_flux()) snapshot.add("alpha_mid", alpha_mid);
  snapshot.add("solid_t", &t);
  snapshot.add("solid_strain_rate", &strain.rate);
  if (auto* k = std::get_if<solid::LeftCauchyGreen>(&kinematics)) snapshot.add("Bt", k->Bt);
  if (auto* k = std::get_if<solid::LogConformation>(&kinematics)) snapshot.add("psi", k->psi);
  if (auto* k = std::get_if<solid::ReferenceMap>(&kinematics)) {
    snapshot.add("map", k->d);
    snapshot.add("map_is_set", k->is_set);
  }
}

void Body::resume() {
  vof::reconstruct(interface, alpha, mesh, reconstruct_scratch);
  std::visit([&](auto& k) { k.resume(alpha_strained(), grad); }, kinematics);
  weigh();
}

}  // namespace fsi
