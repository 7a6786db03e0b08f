#include "libfsi/vof/held_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/pieces.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {
namespace {

/// Distance of a point from the plane that cell c knows.
Real off_plane(const BondPlanes& bond, Index c, const Vec3& x) {
  return std::abs(dot(bond.n[c], x) - bond.s[c]);
}

/// Value, gradient and Laplacian of a shape's distance, by differences over the length e.
struct Distance {
  Real value;
  Vec3 gradient;
  Real laplacian;
};

Distance distance(const shapes::Shape& shape, const Vec3& x, Real value, Real e, int dim) {
  Distance result{value, {}, 0};
  for (int i = 0; i < dim; ++i) {
    Vec3 step;
    step[i] = e;
    const Real ahead = shape(x + step), behind = shape(x - step);
    result.gradient[i] = (ahead - behind) / (2 * e);
    result.laplacian += (ahead - 2 * value + behind) / (e * e);
  }
  return result;
}

/// The least distance over the periodic images, and the periods of its image: found by descent from
/// those of the last point.
Real nearest_image(Vec3& xi, Vec3& laps, const shapes::Shape& shape, const Mesh& mesh) {
  Real least = shape(xi + laps);
  for (bool nearer = mesh.translation.size() > 1; nearer;) {
    nearer = false;
    for (const Vec3& shift : mesh.translation) {
      const Vec3 there = laps + shift;  // exact for two periods: no rounding of the way to it
      const Real value = shape(xi + there);
      if (!(value < least)) continue;
      least = value, laps = there, nearer = true;
    }
  }
  xi += laps;
  return least;
}

/// Whether xi - l grad l / |grad l|^2, the point of the undeformed surface next to xi, lies at a
/// bonded wall near c.
bool is_bond(const ShapeMap& map, Index c, const Vec3& xi, const Distance& at, Real h) {
  constexpr Real touching = 0.1;  // of a cell
  if (map.bond == nullptr || norm2(map.bond->n[c]) == 0) return false;
  const Vec3 foot = xi - (at.value / norm2(at.gradient)) * at.gradient;
  return off_plane(*map.bond, c, foot) < touching * h;
}

void list_planes(const ShapeMap& map, const CellField<Real>& alpha, const Mesh& mesh,
                 HoldScratch& s) {
  s.cells.clear(), s.planes.clear(), s.weight.clear();
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.weight[i] <= 0) continue;
    const Index c = map.cells[i];
    const Real h = cell_size(mesh, c);
    Vec3 xi = mesh.C[c] + map.d[c];
    const Real value = nearest_image(xi, s.laps, map.shape, mesh);
    // Full or empty cells on the right side, a cell away from the surface, need no change.
    constexpr Real near = 2, away = 1.2;  // cells
    const Real whole = value > 0 ? 0 : 1;
    if (std::abs(value) > near * h || (alpha[c] == whole && std::abs(value) > away * h)) continue;
    const Distance at = distance(map.shape, xi, value, 1e-3 * h, mesh.dim);
    const Vec3 g = at.gradient + dot(transpose(map.gradient[c]), at.gradient);
    const Real slope = norm(g), k = std::clamp(at.laplacian, -1 / h, 1 / h);
    if (!(slope > 0) || is_bond(map, c, xi, at, h)) continue;
    s.cells.push_back(c), s.weight.push_back(map.weight[i]);
    s.planes.push_back({g / slope, -(at.value + k * h * h / 24) / slope});
  }
}

/// A plane below which there is nothing, for each stray.
void list_strays(std::span<const Index> strays, HoldScratch& s) {
  constexpr Real nothing = -0.25 * std::numeric_limits<Real>::max();
  for (const Index c : strays) {
    s.cells.push_back(c), s.weight.push_back(1);
    s.planes.push_back({Vec3{1, 0, 0}, nothing});
  }
}

/// Sets `change` to the change by the planes, moved outward by shift. totals: of change V and of
/// area.
void set_changes(std::array<Real, 2>& totals, const CellField<Real>& alpha, const Mesh& mesh,
                 Real shift, HoldScratch& s) {
  constexpr Real most = 0.05;
  std::array<Sum, 2> sums;
  s.change.resize(s.cells.size());
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const Index c = s.cells[i];
    gather(s.cell, mesh, c);
    const geometry::Plane plane{s.planes[i].n, s.planes[i].s + shift};
    const geometry::Below below = geometry::below(s.cell, plane);
    const Real asked = below.measure / mesh.V[c] - alpha[c];
    s.change[i] = s.weight[i] * std::clamp(asked, -most, most);
    sums[0].add(mesh.V[c] * s.change[i]);
    if (std::abs(asked) < most) sums[1].add(s.weight[i] * below.area);
  }
  Sum::totals(totals, sums);
}

/// Sets `change` for the shift that keeps the volume, and returns the volume that it adds
/// nevertheless. Newton's method, bounded by a shift that gives too little and one that gives too
/// much. Its steps would alternate if the change of many cells is limited. The change grows with
/// the shift, so both bounds stay valid.
Real set_change_of_no_volume(const CellField<Real>& alpha, Real volume, const Mesh& mesh,
                             HoldScratch& s) {
  constexpr int rounds = 20;
  constexpr Real enough = 1e-7;  // of the volume; the rest goes to the cut cells
  constexpr Real none = std::numeric_limits<Real>::infinity();
  const Real longest =
      std::pow(volume, Real{1} / mesh.dim) / 8;  // of a step, where the area is small
  Real off = volume, shift = 0, little = -none, much = none;
  for (int i = 0; i < rounds; ++i) {
    std::array<Real, 2> totals{};
    set_changes(totals, alpha, mesh, shift, s);
    off = totals[0];
    if (std::abs(off) <= enough * volume) break;
    (off < 0 ? little : much) = shift;
    const Real next = totals[1] > 0 ? shift - std::clamp(off / totals[1], -longest, longest) : none;
    if (next > little && next < much) {
      shift = next;
    } else if (much - little < none) {
      shift = (little + much) / 2;
    } else {
      break;
    }
  }
  return off;
}

}  // namespace

// Ring by ring, so that the result does not depend on the order of the cells.
BondPlanes::BondPlanes(const Mesh& mesh, std::span<const Index> bonded, int rings)
    : n(mesh), s(mesh) {
  CellField<Real> ring(mesh);  // 1 + that of the cell; 0: none
  const auto take = [&](Index c, const Vec3& n_new, Real s_new) {
    const bool nearer = std::abs(dot(n_new, mesh.C[c]) - s_new) < off_plane(*this, c, mesh.C[c]);
    if (ring[c] == 0 || nearer) n[c] = n_new, s[c] = s_new;
  };
  for (const Index f : bonded) {
    const Vec3 out = mesh.normal(f);
    take(mesh.owner[f], out, dot(out, mesh.Cf[f]));
    ring[mesh.owner[f]] = 1;
  }
  for (int k = 1; k <= rings; ++k) {
    mesh.halo.update(n), mesh.halo.update(s), mesh.halo.update(ring);
    for (Index c = 0; c < mesh.n_owned; ++c) {
      if (ring[c] > 0 && ring[c] <= k) continue;
      for (const Index b : mesh.cell_neighbours[c])
        if (ring[b] > 0 && ring[b] <= k) take(c, n[b], s[b]), ring[c] = k + 1;
    }
  }
}

void mark_cut(CellField<Real>& near, const CellField<Real>& alpha, const ShapeMap& map,
              const Mesh& mesh, int rings, std::span<const Index> at_openings) {
  const auto empty = [&](Index c) { return alpha[c] < 0.5; };
  near.fill(0);
  Vec3 laps;
  for (const Index c : map.cells) {
    if (!empty(c) || !std::ranges::all_of(mesh.cell_neighbours[c], empty)) continue;
    Vec3 xi = mesh.C[c] + map.d[c];
    if (nearest_image(xi, laps, map.shape, mesh) < 0) near[c] = 1 + rings;
  }
  for (const Index c : at_openings) near[c] = 1 + rings;
  mesh.halo.update(near);
  spread_marks(near, rings, mesh, [](Index) { return true; });
}

Held hold_shape(CellField<Real>& alpha, const ShapeMap& map, const Mesh& mesh, HoldScratch& s) {
  list_planes(map, alpha, mesh, s);
  const std::size_t first_stray = s.cells.size();
  list_strays(map.strays, s);
  Sum solid;
  for (const Index c : map.cells) solid.add(mesh.V[c] * alpha[c]);
  const Real volume = solid.total();
  constexpr Real left = 1e-5;  // of the volume: more cannot go to the cut cells
  if (!(std::abs(set_change_of_no_volume(alpha, volume, mesh, s)) <= left * volume))
    return {};  // no shift keeps the volume: the map gives no shape
  // volume added, weight of the cells that give it back, volume moved, and that of the strays
  std::array<Sum, 4> sums;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const Index c = s.cells[i];
    const Real a = alpha[c] + s.change[i];
    constexpr Real wisp = 1e-9;
    const Real to = a < wisp ? 0 : a > 1 - wisp ? 1 : a;
    sums[0].add((to - alpha[c]) * mesh.V[c]);
    if (i < first_stray) sums[1].add(mesh.V[c] * to * (1 - to));
    sums[2].add(std::abs(to - alpha[c]) * mesh.V[c]);
    if (i >= first_stray) sums[3].add((alpha[c] - to) * mesh.V[c]);
    s.change[i] = alpha[c];
    alpha[c] = to;
  }
  std::array<Real, 4> totals{};
  Sum::totals(totals, sums);
  const bool whole = std::abs(totals[0]) <= totals[1];  // of the volume can be given back
  const Real factor = totals[1] > 0 ? -totals[0] / totals[1] : 0;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    Real& a = alpha[s.cells[i]];
    if (!whole)
      a = s.change[i];
    else if (i < first_stray)
      a += factor * a * (1 - a);
  }
  mesh.halo.update(alpha);
  return whole && volume > 0 ? Held{totals[2] / volume, totals[3]} : Held{};
}

}  // namespace fsi::vof
