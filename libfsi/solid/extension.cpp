#include "libfsi/solid/extension.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/solid/regression.hpp"

namespace fsi::solid {
namespace {

constexpr Real near_zone = 1, inner_zone = 2, surrounded_zone = 3;

/// Whether a face of the cell has a known cell behind it.
bool beside_known(Index c, const CellField<Real>& alpha, const Mesh& mesh) {
  return std::ranges::any_of(mesh.cell_faces[c], [&](Index f) {
    return f < mesh.n_internal &&
           alpha[mesh.owner[f] == c ? mesh.neighbour[f] : mesh.owner[f]] >= alpha_known;
  });
}

/// The zone of a known cell.
Real zone(Index c, const CellField<Real>& alpha, const Mesh& mesh) {
  bool wall = false;
  for (const Index f : mesh.cell_faces[c]) {
    wall = wall || f >= mesh.n_internal;
    if (f < mesh.n_internal &&
        !(alpha[mesh.owner[f] == c ? mesh.neighbour[f] : mesh.owner[f]] >= alpha_known))
      return near_zone;
  }
  return wall ? inner_zone : surrounded_zone;
}

Real product(const SymTensor& a, const SymTensor& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2 * (a.xy * b.xy + a.xz * b.xz + a.yz * b.yz);
}

Real product(const SymGradient& a, const SymGradient& b) {
  return product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z);
}

void add(SymGradient& sum, Real factor, const SymGradient& g) {
  sum.x += factor * g.x, sum.y += factor * g.y, sum.z += factor * g.z;
}

/// Calls f(k, r) for the vertex neighbours k of cell c, r from the centre of k to that of c.
template <class Function>
void for_neighbours(Index c, const Mesh& mesh, Function&& f) {
  const Csr& neighbours = mesh.cell_neighbours;
  for (Index i = neighbours.offset[c]; i < neighbours.offset[c + 1]; ++i) {
    const Index k = neighbours.index[i];
    f(k, mesh.C[c] - mesh.C[k] - mesh.translation[mesh.cell_neighbour_shift[i]]);
  }
}

}  // namespace

Extension::Extension(const Mesh& mesh)
    : mesh_(mesh), zone_(mesh), ring_of_(mesh), stamp_(static_cast<std::size_t>(mesh.n_owned), 0) {}

void Extension::mark(const CellField<Real>& alpha, const Band& known) {
  for (const Index c : set_) ring_of_[c] = 0;
  last_set_.swap(set_);
  set_.clear();
  alone_.clear();
  for (const Index c : known.core()) (beside_known(c, alpha, mesh_) ? set_ : alone_).push_back(c);
  end_[0] = set_.size();
  for (const Index c : set_) ring_of_[c] = 1;
  mesh_.halo.update(ring_of_);
  for (int i = 1; i <= rings; ++i) {
    list_ring(1 + i, known);
    end_[i] = set_.size();
    mesh_.halo.update(ring_of_);
  }
  for (const Index c : near_) zone_[c] = 0;
  near_ = last_set_;
  near_.insert(near_.end(), set_.begin(), set_.end());
  near_.insert(near_.end(), alone_.begin(), alone_.end());
  for (const Index c : near_) zone_[c] = near_zone;
  for (const Index c : known.core()) zone_[c] = zone(c, alpha, mesh_);
  mesh_.halo.update(zone_);
}

void Extension::list_ring(Real ring, const Band& known) {
  ++calls_;
  const auto list = [&](Index c) {
    if (c >= mesh_.n_owned || ring_of_[c] > 0 || stamp_[c] == calls_) return;
    stamp_[c] = calls_;
    set_.push_back(c);
  };
  const std::size_t begin = set_.size();
  for (std::size_t i = 0; i < begin; ++i)
    if (ring_of_[set_[i]] >= ring - 1)
      for (const Index n : mesh_.cell_neighbours[set_[i]]) list(n);
  for (Index c = mesh_.n_owned; c < mesh_.n_cells; ++c)
    if (ring_of_[c] > 0)
      for (const Index n : known.around_halo()[c - mesh_.n_owned]) list(n);
  for (std::size_t i = begin; i < set_.size(); ++i) ring_of_[set_[i]] = ring;
}

SymGradient Extension::least_squares(const CellField<SymTensor>& T, Index c) const {
  Tensor M;
  SymGradient R;
  for_neighbours(c, mesh_, [&](Index k, const Vec3& r) {
    if (ring_of_[k] != 1) return;
    const Real w = 1 / norm2(r);
    const SymTensor rise = T[c] - T[k];
    M += w * outer(r, r);
    add(R, w, {r.x * rise, r.y * rise, r.z * rise});
  });
  if (M == Tensor{}) return {};
  const Tensor K = inverse_of_moments(M, mesh_.dim);
  return {along(R, {K.xx, K.xy, K.xz}), along(R, {K.yx, K.yy, K.yz}), along(R, {K.zx, K.zy, K.zz})};
}

SymGradient Extension::limited_slope(const CellField<SymGradient>& slope, Index c) const {
  SymGradient mean;
  int n = 0;
  for_neighbours(c, mesh_, [&](Index k, const Vec3& /*r*/) {
    if (zone_[k] < surrounded_zone) return;
    add(mean, 1, slope[k]);
    ++n;
  });
  const SymGradient& g = slope[c];
  const Real square = product(g, g);
  if (n == 0 || !(square > 0)) return {};
  const Real part = std::clamp(product(g, mean) / (n * square), Real{0}, Real{1});
  return {part * g.x, part * g.y, part * g.z};
}

void Extension::set_slopes(CellField<SymGradient>& slope, const CellField<SymTensor>& T) {
  for (const Index c : ring(0)) slope[c] = least_squares(T, c);
  mesh_.halo.update(slope, ring_of_);
  slopes_.clear();
  for (const Index c : ring(0)) slopes_.push_back(limited_slope(slope, c));
  for (std::size_t i = 0; i < slopes_.size(); ++i) slope[ring(0)[i]] = slopes_[i];
  mesh_.halo.update(slope, ring_of_);
}

void Extension::linear(CellField<SymTensor>& T, CellField<SymGradient>& slope) {
  mesh_.halo.update(T, ring_of_);
  set_slopes(slope, T);
  for (int i = 1; i <= rings; ++i) {
    for (const Index c : ring(i)) {
      SymTensor sum;
      SymGradient slopes;
      Real weights = 0;
      for_neighbours(c, mesh_, [&](Index k, const Vec3& r) {
        if (ring_of_[k] == 0 || ring_of_[k] > i) return;
        const Real w = 1 / norm2(r);
        sum += w * (T[k] + along(slope[k], r));
        add(slopes, w, slope[k]);
        weights += w;
      });
      T[c] = (1 / weights) * sum;
      slope[c] = {};
      add(slope[c], 1 / weights, slopes);
    }
    mesh_.halo.update(T, ring_of_);
    mesh_.halo.update(slope, ring_of_);
  }
  for (const Index c : set_) slope[c] = {};
  for (const Index c : last_set_)
    if (ring_of_[c] == 0) T[c] = {};
  for (const Index c : alone_)
    if (ring_of_[c] == 0) T[c] = {};
}

void Extension::fourth_difference_filter(CellField<SymTensor>& T, CellField<SymGradient>& slope,
                                         Real speed, Real recovery, Real dt) {
  if (!(speed > 0)) return;
  mesh_.halo.update(T, ring_of_);
  for (const Index c : ring(0)) slope[c] = least_squares(T, c);
  mesh_.halo.update(slope, ring_of_);
  change_.clear();
  for (const Index c : ring(0)) {
    SymTensor sum;
    Real weights = 0;
    for_neighbours(c, mesh_, [&](Index k, const Vec3& r) {
      if (ring_of_[k] != 1) return;
      const Real w = 1 / norm2(r);
      sum += w * (T[k] - T[c] + 0.5 * (along(slope[c], r) + along(slope[k], r)));
      weights += w;
    });
    // Half of it leaves G* = 10 rough on triangles, five times it costs the disc's error a tenth.
    constexpr Real C = 0.1;
    const Real h = mesh_.dim == 2 ? std::sqrt(mesh_.V[c]) : std::cbrt(mesh_.V[c]);
    const Real rate = std::min(speed / h, recovery);
    change_.push_back(((1 - std::exp(-C * rate * dt)) / weights) * sum);
  }
  for (std::size_t i = 0; i < change_.size(); ++i) T[ring(0)[i]] += change_[i];
  for (const Index c : ring(0)) slope[c] = {};
}

void Extension::constant(CellField<SymTensor>& T, const CellField<Real>& where) {
  mesh_.halo.update(T, ring_of_);
  for (int i = 1; i <= rings; ++i) {
    for (const Index c : ring(i)) {
      if (where[c] == 0) continue;
      SymTensor sum;
      Real weights = 0;
      for_neighbours(c, mesh_, [&](Index k, const Vec3& r) {
        if (ring_of_[k] == 0 || ring_of_[k] > i || where[k] == 0) return;
        sum += (1 / norm2(r)) * T[k];
        weights += 1 / norm2(r);
      });
      if (weights > 0) T[c] = (1 / weights) * sum;
    }
    mesh_.halo.update(T, ring_of_);
  }
}

}  // namespace fsi::solid
