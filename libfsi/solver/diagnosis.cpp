// The place where a state is worst, if a run cannot continue: figure, place, cell and the term that
// asks for a shorter step.

#include "libfsi/solver/diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/mesh/figures.hpp"
#include "libfsi/mesh/quality.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi {
namespace {

/// The figure of every owned cell, 0 or more; not a number counts as infinite.
template <class Figure>
std::vector<Real> figures(const Mesh& mesh, const Figure& figure) {
  std::vector<Real> values(static_cast<std::size_t>(mesh.n_owned));
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const Real value = figure(c);
    values[c] = std::isfinite(value) ? value : std::numeric_limits<Real>::max();
  }
  return values;
}

/// Collective. The largest figure and its place.
template <class Figure>
Worst worst_of(const Figure& figure, const Mesh& mesh) {
  return worst(figures(mesh, figure), mesh, 1).front();
}

/// Collective. "at (x, y, z) in a tet of aspect ratio 40 (skewness ..., ...)".
std::string place(const Worst& w, const Mesh& mesh) {
  const CellQuality cells = cell_quality(mesh);
  const Real aspect = value_at(cells.aspect_ratio, w.cell, mesh),
             angle = value_at(cells.non_orthogonality, w.cell, mesh),
             skewness = value_at(cells.skewness, w.cell, mesh),
             ratio = value_at(cells.volume_ratio, w.cell, mesh);
  return print(
      "at (%.5g, %.5g, %.5g) in a %s of aspect ratio %.3g (non-orthogonality %.3g deg, "
      "skewness %.3g, volume ratio %.3g)",
      w.x.x, w.x.y, w.x.z, name_of(w.type), aspect, angle, skewness, ratio);
}

Real size_of(const Tensor& L) {
  return std::sqrt(L.xx * L.xx + L.xy * L.xy + L.xz * L.xz + L.yx * L.yx + L.yy * L.yy +
                   L.yz * L.yz + L.zx * L.zx + L.zy * L.zy + L.zz * L.zz);
}

/// Collective. 1 / (smallest eigenvalue of B) in cells half solid or more, if one of them is past
/// the limit. Otherwise in all cells with B, also those of specks. 0 in other cells.
std::vector<Real> inverse_eigenvalues(const Body& body, const Mesh& mesh) {
  std::vector<Real> all(static_cast<std::size_t>(mesh.n_owned)), known = all;
  bool past = false;
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (body.alpha[c] <= 0 || !(trace(body.B[c]) > 0)) continue;
    all[c] = 1 / std::max(eigen(body.B[c]).value[0], std::numeric_limits<Real>::min());
    if (body.alpha[c] < solid::alpha_known) continue;
    known[c] = all[c];
    past = past || known[c] * eigenvalue_limit > 1;
  }
  return all_of_ranks(!past) ? all : known;
}

/// Collective. Where a figure is largest: "WHAT is 3.2 at ... in ...: WHY".
template <class Figure>
std::string at_worst(const Mesh& mesh, const Figure& figure, const char* what, const char* why) {
  const Worst w = worst_of(figure, mesh);
  return what + print(" is %.3g ", w.value) + place(w, mesh) + (*why != 0 ? ": " : "") + why;
}

/// Collective. Empty where the body force is not what makes a step of dt too long.
std::string diagnosis_of_force(const Solver& solver, Term term, Real dt) {
  const Mesh& mesh = solver.mesh();
  const auto& driving_force = solver.driving_force();
  const bool of_flow = term == Term::solve || term == Term::convection || term == Term::pressure;
  if (!driving_force || !of_flow) return "";
  // A step that failed in a solve did not reach its end.
  const Real t = solver.state().t + (term == Term::solve ? dt : -dt) / 2;
  const auto force = [&](Index c) { return norm(driving_force(mesh.C[c], t)); };
  // |f| dt^2 / (2 rho h)
  const auto cells = [&](Index c) {
    Real widest = 0;
    for (const Index f : mesh.cell_faces[c]) widest = std::max(widest, norm(mesh.Sf[f]));
    return force(c) * dt * dt / (2 * solver.physics().rho) * widest / mesh.V[c];
  };
  const Worst w = worst_of(cells, mesh);
  if (!(w.value > 1)) return "";
  const auto lost = [&](Index c) { return std::isfinite(force(c)) ? 0.0 : 1.0; };
  if (const Worst first = worst_of(lost, mesh); first.value > 0)
    return print("the body force has its first value that is not finite at (%.5g, %.5g, %.5g)",
                 first.x.x, first.x.y, first.x.z);
  const Real largest = norm(driving_force(w.x, t));
  return print(
      "the body force is %.3g at (%.5g, %.5g, %.5g) and would take fluid at rest through %.3g "
      "cells in the step; look at its size and its units",
      largest, w.x.x, w.x.y, w.x.z, w.value);
}

/// Collective. Of a body whose limit a step of dt passes; L: as it strained the body.
std::string diagnosis_of_solid(const Body& body, const FaceField<Real>& phi,
                               const CellField<Tensor>& L, Term term, Real dt) {
  const Mesh& mesh = body.mesh;
  // Figures of the solid are those of cells with some of it.
  const auto of_solid = [&](const auto& figure) {
    return [&](Index c) { return body.alpha[c] > 0 ? figure(c) : 0; };
  };
  const auto courant = [&](Index c) { return body.dt * courant_rate(phi, mesh, c); };
  const auto waves = [&](Index c) {
    return dt / solid::elastic_time(body.lambda, body.G, body.rho, body.wave_width, {&c, 1});
  };
  const std::vector<Real> inverse = inverse_eigenvalues(body, mesh);
  const auto crushed = [&](Index c) { return inverse[c]; };
  switch (term) {
    case Term::transport:
      return at_worst(mesh, of_solid(courant), "the largest Courant number of the solid's step",
                      "the transport of the solid limits");
    case Term::fraction:
      return at_worst(
          mesh, [&](Index c) { return std::max(body.alpha[c] - 1, -body.alpha[c]); },
          "the largest excess of the fraction", "the transport of the solid limits");
    case Term::elasticity:
      return at_worst(mesh, of_solid(waves),
                      "the largest number of cells that the elastic wave passes",
                      "the solid's stiffness limits");
    case Term::strain:
      return at_worst(mesh, of_solid([&](Index c) { return size_of(L[c]); }),
                      "the largest velocity gradient in the solid", "its rate of strain limits");
    default:
      return at_worst(mesh, crushed, "the largest inverse of an eigenvalue of B",
                      "the solid is crushed there");
  }
}

}  // namespace

Rejection holder(const Solver& solver, Real dt) {
  Rejection holder{"a hundred steps in a row of less than a millionth of the largest",
                   Term::convection, nullptr};
  Real most = dt / solver.advective_dt(1);
  for (const Body& body : solver.bodies())
    if (const Real part = dt / solver.elastic_dt(body); part > most)
      most = part, holder.term = Term::elasticity, holder.body = &body;
  if (solver.bodies().empty() || dt / solver.strain_dt(solid::strain_max) <= most) return holder;
  holder.term = Term::strain;
  if (holder.body == nullptr) holder.body = solver.body();
  return holder;
}

std::string Solver::diagnosis(const Rejection& rejection, Real dt) {
  const Term term = rejection.term;
  if (std::string of_force = diagnosis_of_force(*this, term, dt); !of_force.empty())
    return of_force;
  if (term == Term::pressure) {
    flow::divergence(divergence_, state_.phi, mesh_);
    return at_worst(
        mesh_, [&](Index c) { return dt * std::abs(divergence_[c]); },
        "the largest change of volume that the pressure leaves, in parts of the cell,",
        "the pressure's solver limits (-p_ksp_rtol, -p_ksp_max_it)");
  }
  if (term != Term::convection && term != Term::solve)
    return diagnosis_of_solid(*rejection.body, state_.phi, L_, term, dt);
  for (const Body& body : bodies_)
    if (body.beyond_law)
      return at_worst(
          mesh_,
          [&](Index c) { return body.alpha[c] >= solid::alpha_known ? trace(body.B[c]) - 3 : 0; },
          "the largest tr B - 3", "the law of the solid ends there");
  const auto lost = [&](Index c) {
    Real sum = norm2(state_.u[c]) + state_.p[c] + courant_rate(state_.phi, mesh_, c);
    for (const Index f : mesh_.cell_faces[c])
      if (f >= mesh_.n_internal) sum += norm2(u_b_new_[f - mesh_.n_internal]);
    return std::isfinite(sum) ? 0.0 : 1.0;
  };
  if (const Worst w = worst_of(lost, mesh_); w.value > 0)
    return "the first value that is not finite is " + place(w, mesh_);
  const Worst speed = worst_of([&](Index c) { return norm(state_.u[c]); }, mesh_);
  const std::vector<Real> rates = courant_rates();
  return at_worst(
             mesh_, [&](Index c) { return dt * rates[c]; }, "the largest Courant number",
             term == Term::solve ? "" : "convection limits") +
         print("; the largest speed is %.3g at (%.5g, %.5g, %.5g)", speed.value, speed.x.x,
               speed.x.y, speed.x.z);
}

}  // namespace fsi
