#include "libfsi/solid/extension.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/alternation.hpp"

namespace fsi::solid {
namespace {

constexpr Real near_zone = 1, inner_zone = 2, surrounded_zone = 3;

/// Whether a face neighbour of the cell has alpha >= alpha_known.
bool beside_known(Index c, const CellField<Real>& alpha, const Mesh& mesh) {
  return std::ranges::any_of(mesh.cell_faces[c], [&](Index f) {
    const Index n = beyond(mesh, f, c);
    return n >= 0 && alpha[n] >= alpha_known;
  });
}

/// The value of `zone_` in a known cell.
Real zone(Index c, const CellField<Real>& alpha, const SymmetryFaces& symmetry, const Mesh& mesh) {
  bool wall = false;
  for (const Index f : mesh.cell_faces[c]) {
    const Index n = beyond(mesh, f, c);
    wall = wall || (n < 0 && !symmetry.has(f, mesh));
    if (n >= 0 && !(alpha[n] >= alpha_known)) return near_zone;
  }
  return wall ? inner_zone : surrounded_zone;
}

Real product(const SymGradient& a, const SymGradient& b) {
  return contract(a.x, b.x) + contract(a.y, b.y) + contract(a.z, b.z);
}

}  // namespace

void Extension::mark(const CellField<Real>& alpha, const Band& known) {
  known_.clear(), alone_.clear();
  for (const Index c : known.core()) (beside_known(c, alpha, mesh_) ? known_ : alone_).push_back(c);
  rings_.list(known_, known.around_halo());
  for (const Index c : near_) zone_[c] = 0;
  near_.assign(rings_.before().begin(), rings_.before().end());
  near_.insert(near_.end(), rings_.all().begin(), rings_.all().end());
  near_.insert(near_.end(), alone_.begin(), alone_.end());
  for (const Index c : near_) zone_[c] = near_zone;
  for (const Index c : known.core()) zone_[c] = zone(c, alpha, symmetry_, mesh_);
  mesh_.halo.update(zone_);
}

SymGradient Extension::least_squares(const CellField<SymTensor>& T, Index c) const {
  TensorFit fit;
  for_neighbours_and_images(c, symmetry_, mesh_, [&](Index k, const Vec3& r, const Reflection& n) {
    if (rings_.within(0, k)) fit.add(image(T[k], n) - T[c], r);
  });
  return fit.slope(mesh_.dim);
}

SymGradient Extension::limited_slope(const CellField<SymGradient>& slope, Index c) const {
  SymGradient mean;
  int n = 0;
  for_neighbours_and_images(c, symmetry_, mesh_,
                            [&](Index k, const Vec3&, const Reflection& plane) {
                              if (zone_[k] >= surrounded_zone) mean += image(slope[k], plane), ++n;
                            });
  const SymGradient& g = slope[c];
  const Real square = product(g, g);
  if (n == 0 || !(square > 0)) return {};
  return std::clamp(product(g, mean) / (n * square), Real{0}, Real{1}) * g;
}

void Extension::set_slopes(CellField<SymGradient>& slope, const CellField<SymTensor>& T) {
  for (const Index c : known_) slope[c] = least_squares(T, c);
  mesh_.halo.update(slope, rings_.number());
  slopes_.clear();
  for (const Index c : known_) slopes_.push_back(limited_slope(slope, c));
  for (std::size_t i = 0; i < slopes_.size(); ++i) slope[known_[i]] = slopes_[i];
  mesh_.halo.update(slope, rings_.number());
}

void Extension::linear(CellField<SymTensor>& T, CellField<SymGradient>& slope) {
  mesh_.halo.update(T, rings_.number());
  set_slopes(slope, T);
  for (int i = 1; i <= Rings::count; ++i) {
    for (const Index c : rings_.ring(i)) {
      SymTensor sum;
      SymGradient slopes;
      Real weights = 0;
      for_neighbours_and_images(c, symmetry_, mesh_,
                                [&](Index k, const Vec3& r, const Reflection& n) {
                                  if (!rings_.within(i - 1, k)) return;
                                  const Real w = 1 / norm2(r);
                                  const SymGradient of_k = image(slope[k], n);
                                  sum += w * (image(T[k], n) - along(of_k, r));
                                  slopes += w * of_k;
                                  weights += w;
                                });
      T[c] = (1 / weights) * sum;
      slope[c] = (1 / weights) * slopes;
    }
    mesh_.halo.update(T, rings_.number());
    mesh_.halo.update(slope, rings_.number());
  }
  for (const Index c : rings_.all()) slope[c] = {};
  for (const std::span<const Index> cells : {rings_.before(), std::span<const Index>(alone_)})
    for (const Index c : cells)
      if (rings_.number()[c] == 0) T[c] = {};
}

void Extension::fourth_difference_filter(CellField<SymTensor>& T, CellField<SymGradient>& slope,
                                         const CellField<Real>& where, Real speed, Real recovery,
                                         Real dt) {
  if (!(speed > 0)) return;
  mesh_.halo.update(T, rings_.number());
  for (const Index c : known_) slope[c] = least_squares(T, c);
  mesh_.halo.update(slope, rings_.number());
  change_.clear();
  const auto known = [&](Index k) { return rings_.within(0, k); };
  const auto rise = [&](Index k, const Vec3& r) { return along(slope[k], r); };
  for (const Index c : known_) {
    if (where[c] == 0) {
      change_.emplace_back();
      continue;
    }
    const Real part = alternating_part(speed, recovery, cell_size(mesh_, c), dt);
    change_.push_back(part * alternation(T, known, rise, mesh_, symmetry_, c));
  }
  for (std::size_t i = 0; i < change_.size(); ++i) T[known_[i]] += change_[i];
  for (const Index c : known_) slope[c] = {};
}

void Extension::constant(CellField<SymTensor>& T, const CellField<Real>& where) {
  mesh_.halo.update(T, rings_.number());
  for (int i = 1; i <= Rings::count; ++i) {
    for (const Index c : rings_.ring(i)) {
      if (where[c] == 0) continue;
      SymTensor sum;
      Real weights = 0;
      for_neighbours_and_images(c, symmetry_, mesh_,
                                [&](Index k, const Vec3& r, const Reflection& n) {
                                  if (!rings_.within(i - 1, k) || where[k] == 0) return;
                                  sum += (1 / norm2(r)) * image(T[k], n);
                                  weights += 1 / norm2(r);
                                });
      if (weights > 0) T[c] = (1 / weights) * sum;
    }
    mesh_.halo.update(T, rings_.number());
  }
}

}  // namespace fsi::solid
