#include "libfsi/vof/advect.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi::vof {

Advect::Advect(const Mesh& mesh)
    : mesh_(mesh),
      speed_(mesh),
      volume_(mesh),
      received_(mesh),
      face_stamp_(static_cast<std::size_t>(mesh.n_faces), 0),
      cell_stamp_(static_cast<std::size_t>(mesh.n_cells), 0) {
  for (Index f = 0; f < mesh.n_internal; ++f)
    if (mesh.owner[f] >= mesh.n_owned || mesh.neighbour[f] >= mesh.n_owned)
      between_ranks_.push_back(f);
}

Advected Advect::operator()(CellField<Real>& alpha, const Interface& interface,
                            const FaceField<Real>& phi, const CellField<Vec3>& u,
                            const CellField<Tensor>& L, Real dt) {
  set_speed(interface, u, L);
  list_faces(alpha);
  set_fluxes(alpha, interface, phi, dt);
  apply(alpha);
  constexpr int most = 10;
  constexpr Real tolerance = 1e-12;
  Advected result;
  for (result.overshoot = worst(alpha); result.overshoot > tolerance && result.passes < most;
       ++result.passes) {
    redistribute(alpha, phi, dt);
    result.overshoot = worst(alpha);
  }
  return result;
}

void Advect::set_speed(const Interface& interface, const CellField<Vec3>& u,
                       const CellField<Tensor>& L) {
  // U_n = n . (u_c + L . (x_s - x_c))
  for (const Index c : interface.cells)
    speed_[c] = dot(interface.normal[c], u[c] + dot(L[c], interface.centre[c]));
  mesh_.halo.update(speed_);
}

void Advect::list_faces(const CellField<Real>& alpha) {
  faces_.clear();
  cells_.clear();
  ++calls_;
  const auto list = [&](Index c) {
    if (c >= mesh_.n_owned || cell_stamp_[c] == calls_) return;
    cell_stamp_[c] = calls_;
    cells_.push_back(c);
  };
  const auto list_face = [&](Index f) {
    if (face_stamp_[f] == calls_) return;
    face_stamp_[f] = calls_;
    faces_.push_back(f);
    list(mesh_.owner[f]);
    if (f < mesh_.n_internal) list(mesh_.neighbour[f]);
  };
  for (Index c = 0; c < mesh_.n_owned; ++c)
    if (alpha[c] > 0)
      for (const Index f : mesh_.cell_faces[c]) list_face(f);
  for (const Index f : between_ranks_)
    if (alpha[mesh_.owner[f]] > 0 || alpha[mesh_.neighbour[f]] > 0) list_face(f);
}

void Advect::set_fluxes(const CellField<Real>& alpha, const Interface& interface,
                        const FaceField<Real>& phi, Real dt) {
  geometry::Polygon face;
  for (const Index f : faces_) {
    const bool internal = f < mesh_.n_internal;
    const Index up = phi[f] >= 0 || !internal ? mesh_.owner[f] : mesh_.neighbour[f];
    volume_[f] = 0;
    if (!internal && phi[f] <= 0) continue;  // nothing but fluid comes in
    Real part = alpha[up];
    if (norm2(interface.normal[up]) > 0) {
      gather(face, mesh_, f, up);
      const Vec3& n = interface.normal[up];
      part = geometry::mean_part_below(face, n, dot(n, interface.centre[up]), speed_[up], dt);
    }
    volume_[f] = phi[f] * part * dt;
  }
}

void Advect::apply(CellField<Real>& alpha) {
  for (const Index c : cells_) received_[c] = 0;
  for (const Index f : faces_) {
    received_[mesh_.owner[f]] -= volume_[f];
    if (f < mesh_.n_internal) received_[mesh_.neighbour[f]] += volume_[f];
  }
  for (const Index c : cells_) alpha[c] += received_[c] / mesh_.V[c];
  mesh_.halo.update(alpha);
}

Real Advect::worst(const CellField<Real>& alpha) const {
  Real far = 0;
  for (const Index c : cells_) far = std::max({far, -alpha[c], alpha[c] - 1});
  return global_max(far);
}

void Advect::redistribute(CellField<Real>& alpha, const FaceField<Real>& phi, Real dt) {
  received_.fill(0);
  for (const Index c : cells_) {
    if (alpha[c] > 1) pass_on(c, (alpha[c] - 1) * mesh_.V[c], true, phi, dt);
    if (alpha[c] < 0) pass_on(c, -alpha[c] * mesh_.V[c], false, phi, dt);
  }
  mesh_.halo.add_to_owner(received_.data(), 1);
  for (Index c = 0; c < mesh_.n_owned; ++c)
    if (received_[c] != 0) alpha[c] += received_[c] / mesh_.V[c];
  mesh_.halo.update(alpha);
}

void Advect::pass_on(Index c, Real excess, bool solid, const FaceField<Real>& phi, Real dt) {
  // Room of an outflow face: what it carries of the other phase in this step.
  const auto outflow = [&](Index f) { return (mesh_.owner[f] == c ? phi[f] : -phi[f]) * dt; };
  const auto room = [&](Index f) {
    const Real out = outflow(f);
    if (out <= 0 || f >= mesh_.n_internal) return 0.0;
    const Real carried = face_stamp_[f] == calls_ ? std::abs(volume_[f]) : 0;
    return std::max(0.0, solid ? out - carried : carried);
  };
  Real rooms = 0;
  for (const Index f : mesh_.cell_faces[c]) rooms += room(f);
  // Where outflow has no room left the rest stays for the next pass or step.
  const Real share = rooms > excess ? excess / rooms : 1;
  for (const Index f : mesh_.cell_faces[c]) {
    const Real moved = share * room(f) * (solid ? 1 : -1);
    if (moved == 0) continue;
    const bool owner = mesh_.owner[f] == c;
    if (face_stamp_[f] == calls_) volume_[f] += owner ? moved : -moved;
    received_[c] -= moved;
    received_[owner ? mesh_.neighbour[f] : mesh_.owner[f]] += moved;
  }
}

}  // namespace fsi::vof
