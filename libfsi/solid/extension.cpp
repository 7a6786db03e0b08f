#include "libfsi/solid/extension.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi::solid {

Extension::Extension(const Mesh& mesh)
    : mesh_(mesh), item_(mesh), stamp_(static_cast<std::size_t>(mesh.n_owned), 0) {
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Real area = 0;
    for (const Index f : mesh.cell_faces[c]) area = std::max(area, norm(mesh.Sf[f]));
    h_.push_back(mesh.V[c] / area);
  }
}

void Extension::mark_inner(const CellField<SymTensor>& T, const CellField<Real>& alpha,
                           const Band& known) {
  outer_.clear();
  for (const Index c : known.core()) {
    bool inner = true;
    for (const Index f : mesh_.cell_faces[c])
      if (f < mesh_.n_internal)
        inner = inner &&
                alpha[mesh_.owner[f] == c ? mesh_.neighbour[f] : mesh_.owner[f]] >= alpha_known;
    set_.push_back(c);
    if (inner) {
      item_[c] = {T[c], inner_layer};
    } else {
      outer_.push_back(c);
    }
  }
  mesh_.halo.update(item_);
  layer_.clear();
  std::erase_if(outer_, [&](Index c) {
    for (const Index n : mesh_.cell_neighbours[c])
      if (item_[n].layer == inner_layer) return false;
    layer_.push_back(c);
    return true;
  });
  for (const Index c : layer_) item_[c] = {T[c], thin_layer};
  mesh_.halo.update(item_);
}

void Extension::list_ring(Real layer, const Band& known) {
  ++calls_;
  layer_.clear();
  const auto list = [&](Index c) {
    if (c >= mesh_.n_owned || item_[c].layer > 0 || stamp_[c] == calls_) return;
    stamp_[c] = calls_;
    layer_.push_back(c);
  };
  for (const Index c : set_)
    if (item_[c].layer >= layer - 2)
      for (const Index n : mesh_.cell_neighbours[c]) list(n);
  for (Index c = mesh_.n_owned; c < mesh_.n_cells; ++c)
    if (item_[c].layer > 0)
      for (const Index n : known.around_halo()[c - mesh_.n_owned]) list(n);
}

void Extension::fill(Real layer) {
  values_.clear();
  for (const Index c : layer_) {
    SymTensor sum;
    Real weights = 0;
    for (Index i = mesh_.cell_neighbours.offset[c]; i < mesh_.cell_neighbours.offset[c + 1]; ++i) {
      const Item& item = item_[mesh_.cell_neighbours.index[i]];
      if (item.layer == 0) continue;
      const Vec3 x = mesh_.C[mesh_.cell_neighbours.index[i]] +
                     mesh_.translation[mesh_.cell_neighbour_shift[i]];
      const Real w = 1 / norm2(x - mesh_.C[c]);
      sum += w * item.T;
      weights += w;
    }
    values_.push_back((1 / weights) * sum);
  }
  for (std::size_t i = 0; i < layer_.size(); ++i) item_[layer_[i]] = {values_[i], layer};
  mesh_.halo.update(item_);
}

Vec3 Extension::mean(const CellField<Vec3>& u, const CellField<Real>& alpha,
                     const Band& known) const {
  std::array<Sum, 4> sums;
  for (const Index c : known.core()) {
    const Real volume = alpha[c] * mesh_.V[c];
    for (int i = 0; i < 3; ++i) sums[i].add(volume * u[c][i]);
    sums[3].add(volume);
  }
  std::array<Real, 4> total{};
  Sum::totals(total, sums);
  return total[3] > 0 ? Vec3{total[0], total[1], total[2]} / total[3] : Vec3{};
}

void Extension::relax(CellField<SymTensor>& T, const CellField<Vec3>& u, const Vec3& u_s,
                      Real dt) const {
  for (const Index c : outer_) {
    const Real keep = std::exp(-2 * norm(u[c] - u_s) * dt / h_[c]);
    T[c] = item_[c].T + keep * (T[c] - item_[c].T);
  }
}

void Extension::apply(CellField<SymTensor>& T, const CellField<Real>& alpha, const Band& known,
                      const CellField<Vec3>& u, Real dt) {
  for (const Index c : set_) item_[c] = {};
  last_set_.swap(set_);
  set_.clear();
  mark_inner(T, alpha, known);
  layer_ = outer_;
  fill(outer_layer);
  constexpr int rings = 3;
  for (int ring = 1; ring <= rings; ++ring) {
    list_ring(outer_layer + ring, known);
    fill(outer_layer + ring);
    inside_ = set_.size();
    set_.insert(set_.end(), layer_.begin(), layer_.end());
  }
  for (const Index c : last_set_)
    if (item_[c].layer == 0) T[c] = {};
  for (const Index c : set_)
    if (item_[c].layer > outer_layer) T[c] = item_[c].T;
  if (dt > 0) relax(T, u, mean(u, alpha, known), dt);
  mesh_.halo.update(T);
}

}  // namespace fsi::solid
