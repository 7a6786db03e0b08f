#include "libfsi/flow/wall_parabola.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::flow {
namespace {

/// The normal of the wall in the cells that have one face on walls; else zero. Owned and halo.
CellField<Vec3> wall_normals(const Mesh& mesh, const std::vector<Condition>& conditions) {
  CellField<Vec3> normal(mesh);
  std::vector<int> faces(static_cast<std::size_t>(mesh.n_cells), 0);
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (!std::holds_alternative<Wall>(conditions[i])) continue;
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      const Index P = mesh.owner[f];
      normal[P] = ++faces[P] == 1 ? mesh.normal(f) : Vec3{};
    }
  }
  mesh.halo.update(normal);
  return normal;
}

/// 1 on a flat wall, falling to 0 as the normals around turn. An edge is not a curved wall.
Real flatness(const CellField<Vec3>& normal, Index f, const Mesh& mesh) {
  constexpr Real curved = 0.02, edge = 0.7;  // radian; cosine
  const Vec3 n = mesh.normal(f);
  Real turn = 0;
  for (const Index c : mesh.cell_neighbours[mesh.owner[f]])
    if (dot(normal[c], n) > edge) turn = std::max(turn, norm(normal[c] - n));
  return std::max(Real{0}, 1 - turn / curved);
}

}  // namespace

WallParabola::WallParabola(const Mesh& mesh, const std::vector<Condition>& conditions,
                           const GradientStencil& stencil)
    : mesh_(mesh), weights_(stencil.weights), share_(mesh), largest_(mesh) {
  const CellField<Vec3> normal = wall_normals(mesh, conditions);
  const std::vector<char> slips = faces_where(conditions, mesh, lets_slip);
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (!std::holds_alternative<Wall>(conditions[i])) continue;
    for (Index f = mesh.patches[i].begin; f < mesh.patches[i].end; ++f) {
      if (mesh.simplex(mesh.owner[f])) continue;
      if (const Real flat = flatness(normal, f, mesh); flat > 0) add_row(f, stencil, slips, flat);
    }
  }
  any_ = !all_of_ranks(walls_.empty());
  reset();
}

// q is the square of the distance from the plane of face f.
void WallParabola::add_row(Index f, const GradientStencil& stencil, const std::vector<char>& slips,
                           Real flatness) {
  const Index P = mesh_.owner[f];
  const Vec3 n = mesh_.normal(f), &d = mesh_.d[f];
  const auto q = [&](const Vec3& from_P) { return std::pow(dot(n, from_P - d), 2); };
  const Real q_P = q({});
  Real rise = 0;
  std::vector<Term> row;
  for (const Index k : mesh_.cell_faces[P]) {
    const Index b = k - mesh_.n_internal;
    const Vec3 n_k = mesh_.normal(k);
    if (b >= 0 && dot(n_k, n) < -0.5) return;  // a single cell between two walls
    const Real weight = dot(stencil.weight(k, mesh_.owner[k] == P), d);
    if (weight == 0) continue;
    const Vec3 way = outward(mesh_, k, P) * mesh_.d[k];
    const bool at_foot = b >= 0 && slips[static_cast<std::size_t>(b)] != 0;
    rise += weight * (q(at_foot ? dot(way, n_k) * n_k : way) - q_P);
    row.push_back({b < 0 ? beyond(mesh_, k, P) : -1, b, weight});
  }
  if (!(-q_P - rise >= q_P)) return;
  walls_.push_back(f - mesh_.n_internal);
  largest_[walls_.back()] = flatness * q_P / (-q_P - rise);
  terms_.insert(terms_.end(), row.begin(), row.end());
  begin_.push_back(static_cast<Index>(terms_.size()));
}

void WallParabola::reset() { std::copy_n(largest_.data(), mesh_.n_boundary(), share_.data()); }

void WallParabola::keep_off(const CellField<Real>& alpha, std::span<const Index> cells) {
  for (const Index c : cells)
    for (const Index f : mesh_.cell_faces[c]) {
      const Index b = f - mesh_.n_internal;
      if (b < 0 || largest_[b] == 0) continue;
      Real most = alpha[c];
      for (const Index k : mesh_.cell_neighbours[c]) most = std::max(most, alpha[k]);
      share_[b] = std::max(Real{0}, share_[b] - largest_[b] * most);
    }
}

Vec3 WallParabola::excess(std::size_t i, const CellField<Vec3>& u,
                          const BoundaryField<Vec3>& u_b) const {
  const Index b = walls_[i], f = mesh_.n_internal + b;
  const Vec3& u_P = u[mesh_.owner[f]];
  Vec3 sum = u_b[b] - u_P;
  for (Index k = begin_[i]; k < begin_[i + 1]; ++k) {
    const Term& term = terms_[k];
    sum -= term.weight * ((term.cell >= 0 ? u[term.cell] : u_b[term.face]) - u_P);
  }
  return share_[b] * weights_.g[f] * sum;
}

void WallParabola::add_excess(CellField<Vec3>& rest, const FaceField<Real>& mu,
                              const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b) const {
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Index f = mesh_.n_internal + walls_[i];
    rest[mesh_.owner[f]] += mu[f] * excess(i, u, u_b);
  }
}

}  // namespace fsi::flow
