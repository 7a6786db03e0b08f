#include "libfsi/vof/advect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/band.hpp"
#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/vof/face_fraction.hpp"

namespace fsi::vof {
namespace {

constexpr Real bound = 1e-13;    // excess that redistribution leaves
constexpr Real wisp = 1e-12;     // fractions this close to 0 or 1 become 0 or 1
constexpr int max_rounds = 100;  // each moves an excess one cell further

enum Mark : std::uint8_t { none = 0, active = 1, inside = 2 };

bool is_whole(Real alpha) { return alpha == 0 || alpha == 1; }

/// The cell the flux comes from; -1 at an inflow boundary.
Index upwind(const Mesh& mesh, Index f, Real flux) {
  if (flux >= 0) return mesh.owner[f];
  return f < mesh.n_internal ? mesh.neighbour[f] : -1;
}

void clear(AdvectScratch& s) {
  for (const Index f : s.faces) s.face_marked[f] = none, s.solid[f] = 0;
  for (const Index f : s.full) s.face_marked[f] = none, s.solid[f] = 0;
  for (const Index c : s.cells) s.cell_marked[c] = 0;
  s.faces.clear(), s.full.clear(), s.cells.clear();
}

void mark_face(Index f, Real a, Real b, bool boundary, AdvectScratch& s) {
  if (s.face_marked[f] != none) return;
  const bool trivial = a == b && is_whole(a) && !(boundary && a == 1);
  if (trivial && a == 0) return;
  s.face_marked[f] = trivial ? inside : active;
  (trivial ? s.full : s.faces).push_back(f);
}

/// Faces with solid on a side, then the owned cells of those that are not between full cells.
void find_faces(const CellField<Real>& alpha, const Mesh& mesh, AdvectScratch& s) {
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (alpha[c] == 0) continue;
    for (const Index f : mesh.cell_faces[c]) {
      const Index n = beyond(mesh, f, c);
      mark_face(f, alpha[c], alpha[n < 0 ? c : n], n < 0, s);
    }
  }
  for (const Index f : s.rim) {
    mark_face(f, alpha[mesh.owner[f]], alpha[mesh.neighbour[f]], false, s);
  }
  const auto add = [&](Index c) {
    if (c < mesh.n_owned && !s.cell_marked[c]) s.cell_marked[c] = 1, s.cells.push_back(c);
  };
  for (const Index f : s.faces) {
    add(mesh.owner[f]);
    if (f < mesh.n_internal) add(mesh.neighbour[f]);
  }
}

/// Largest (dt / 2V) sum |phi| of the cells that the step changes.
Real courant_number(const FaceField<Real>& phi, Real dt, const Mesh& mesh, const AdvectScratch& s) {
  Real largest = 0;
  for (const Index c : s.cells) largest = std::max(largest, dt * courant_rate(phi, mesh, c));
  return global_max(largest);
}

/// u at the centre of the plane.
void interface_velocity(const Interface& interface, const CellField<Vec3>& u, const Mesh& mesh,
                        AdvectScratch& s) {
  for (const Index c : interface.cells) {
    const Piece& p = interface.piece[c];
    const SymTensor fit = inverse_moments(mesh, c, s.symmetry);
    const Tensor L = slope_at(u, fit, mesh, c, s.symmetry);
    s.velocity[c] = u[c] + dot(L, p.centre - mesh.C[c]);
  }
  mesh.halo.update(s.velocity);
}

void solid_fluxes(const CellField<Real>& alpha, const Interface& interface,
                  const FaceField<Real>& phi, Real dt, const Mesh& mesh, AdvectScratch& s) {
  for (const Index f : s.full) s.solid[f] = phi[f] * dt;
  for (const Index f : s.faces) {
    const Real v = phi[f] * dt;
    const Index c = upwind(mesh, f, v);
    if (c < 0) {
      s.solid[f] = 0;
      continue;
    }
    const Piece& p = interface.piece[c];
    if (!(p.area > 0)) {
      s.solid[f] = v * std::clamp(alpha[c], Real{0}, Real{1});
      continue;
    }
    // dV = phi integral over dt of A(t) / A   [Roenby16]
    const Vec3 way = dt * s.velocity[c];
    const Real along = dot(p.n_hat, way);
    s.solid[f] = v * (bends(mesh, c) ? swept_part(mesh, f, c, p, s.bend[c], 0.5 * way, 0, along)
                                     : swept_part(mesh, f, c, p, 0, along));
  }
}

/// alpha after the step: alpha V <- alpha V - sum sigma (dV - alpha phi dt). The second part
/// removes the divergence of phi, so that nothing changes inside the solid.
Real updated(const CellField<Real>& alpha, const FaceField<Real>& phi, Real dt, const Mesh& mesh,
             const AdvectScratch& s, Index c) {
  Real sum = 0;
  for (const Index f : mesh.cell_faces[c]) {
    sum += outward(mesh, f, c) * (s.solid[f] - alpha[c] * (phi[f] * dt));
  }
  return alpha[c] - sum / mesh.V[c];
}

/// The share of its outflow by which cell c must change to bring its value a back into [0, 1]. It
/// is positive if more must leave.
Real needed_share(const FaceField<Real>& phi, Real dt, const Mesh& mesh, const AdvectScratch& s,
                  Index c, Real a) {
  const bool over = a > 1;
  Real capacity = 0;
  for (const Index f : mesh.cell_faces[c]) {
    const Real v = phi[f] * dt;
    if (upwind(mesh, f, v) != c) continue;
    capacity += over ? std::abs(v) - std::abs(s.solid[f]) : std::abs(s.solid[f]);
  }
  const Real excess = (over ? a - 1 : -a) * mesh.V[c];
  if (!(capacity > 0)) return 0;
  return (over ? 1 : -1) * std::min(Real{1}, excess / capacity);
}

/// Redistribution in the spirit of [Roenby16] 3.4: as a share of each outflow, so that both ranks
/// of a face compute the same.
void redistribute(const CellField<Real>& alpha, const FaceField<Real>& phi, Real dt,
                  const Mesh& mesh, AdvectScratch& s, AdvectReport& report) {
  for (int round = 0;; ++round) {
    Real worst = 0;
    for (const Index c : s.cells) {
      const Real a = updated(alpha, phi, dt, mesh, s, c);
      const Real excess = std::max(a - 1, -a);
      worst = std::max(worst, excess);
      s.share[c] = excess > bound ? needed_share(phi, dt, mesh, s, c, a) : 0;
    }
    report.remaining = global_max(worst);
    if (report.remaining <= bound || round == max_rounds) break;
    mesh.halo.update(s.share);
    for (const Index f : s.faces) {
      const Real v = phi[f] * dt;
      const Index c = upwind(mesh, f, v);
      if (c < 0) continue;
      const Real share = s.share[c];
      s.solid[f] += share > 0 ? share * (v - s.solid[f]) : share * s.solid[f];
    }
  }
  for (const Index c : s.cells) s.share[c] = 0;
}

/// The volume that the term in div phi adds: sum over cells of alpha sum sigma phi dt. By Gauss's
/// theorem only faces between different alpha count.
void add_divergence(Sum& sum, const CellField<Real>& alpha, const FaceField<Real>& phi, Real dt,
                    const Mesh& mesh, const AdvectScratch& s) {
  for (const Index f : s.faces) {
    const Index P = mesh.owner[f];
    if (P >= mesh.n_owned) continue;  // the other rank counts it
    const Real beyond_it = f < mesh.n_internal ? alpha[mesh.neighbour[f]] : 0;
    sum.add(phi[f] * dt * (alpha[P] - beyond_it));
  }
}

}  // namespace

AdvectScratch::AdvectScratch(const Mesh& mesh, SymmetryFaces planes)
    : symmetry(std::move(planes)),
      solid(mesh),
      rim(faces_between_ranks(mesh)),
      face_marked(static_cast<std::size_t>(mesh.n_faces), none),
      cell_marked(static_cast<std::size_t>(mesh.n_owned), 0),
      velocity(mesh),
      any_bends(any_cell_bends(mesh)),
      bend(mesh),
      cell(mesh.dim),
      share(mesh) {}

AdvectReport advect(CellField<Real>& alpha, const Interface& interface, const FaceField<Real>& phi,
                    const CellField<Vec3>& u, Real dt, const Mesh& mesh, AdvectScratch& s) {
  clear(s);
  find_faces(alpha, mesh, s);
  interface_velocity(interface, u, mesh, s);
  if (s.any_bends) set_bend(s.bend, interface, mesh, s.symmetry, s.cell);
  solid_fluxes(alpha, interface, phi, dt, mesh, s);
  AdvectReport report;
  report.courant = courant_number(phi, dt, mesh, s);
  redistribute(alpha, phi, dt, mesh, s, report);

  std::array<Sum, 2> sums;  // volume added, weight of the cells that give it back
  add_divergence(sums[0], alpha, phi, dt, mesh, s);
  for (const Index c : s.cells) {
    const Real a = updated(alpha, phi, dt, mesh, s, c);
    alpha[c] = std::abs(a) < wisp ? 0 : std::abs(a - 1) < wisp ? 1 : a;
    sums[0].add((alpha[c] - a) * mesh.V[c]);
    sums[1].add(mesh.V[c] * alpha[c] * (1 - alpha[c]));
  }
  std::array<Real, 2> totals{};
  Sum::totals(totals, sums);
  report.returned = std::abs(totals[0]);
  const Real factor = totals[1] > 0 ? std::clamp(-totals[0] / totals[1], Real{-1}, Real{1}) : 0;
  for (const Index c : s.cells) alpha[c] += factor * alpha[c] * (1 - alpha[c]);
  mesh.halo.update(alpha);
  return report;
}

}  // namespace fsi::vof
