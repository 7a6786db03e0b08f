#include "libfsi/solid/extension.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "libfsi/core/parallel.hpp"

namespace fsi::solid {

namespace {

/// Whether all face neighbours of c are known.
bool is_inner(Index c, const CellField<Real>& alpha, const Mesh& mesh) {
  for (const Index f : mesh.cell_faces[c])
    if (f < mesh.n_internal &&
        !(alpha[mesh.owner[f] == c ? mesh.neighbour[f] : mesh.owner[f]] >= alpha_known))
      return false;
  return true;
}

}  // namespace

Extension::Extension(const Mesh& mesh)
    : mesh_(mesh),
      inner_(mesh),
      layer_of_(mesh),
      stamp_(static_cast<std::size_t>(mesh.n_owned), 0) {
  for (Index c = 0; c < mesh.n_owned; ++c) {
    Real area = 0;
    for (const Index f : mesh.cell_faces[c]) area = std::max(area, norm(mesh.Sf[f]));
    h_.push_back(mesh.V[c] / area);
  }
}

void Extension::mark(const CellField<Real>& alpha, const Band& known) {
  for (const Index c : known.last_core()) inner_[c] = 0;
  for (const Index c : known.core()) inner_[c] = is_inner(c, alpha, mesh_) ? 1 : 0;
  mesh_.halo.update(inner_);
}

void Extension::sort(const Band& known) {
  for (const Index c : set_) layer_of_[c] = 0;
  last_set_.swap(set_);
  set_.clear(), outer_.clear();
  for (const Index c : known.core()) {
    set_.push_back(c);
    if (inner(c)) {
      layer_of_[c] = inner_layer;
    } else {
      outer_.push_back(c);
    }
  }
  layer_.clear();
  std::erase_if(outer_, [&](Index c) {
    for (const Index n : mesh_.cell_neighbours[c])
      if (inner(n)) return false;
    layer_.push_back(c);
    return true;
  });
  for (const Index c : layer_) layer_of_[c] = thin_layer;
  mesh_.halo.update(layer_of_);
}

void Extension::list_ring(Real layer, const Band& known) {
  ++calls_;
  layer_.clear();
  const auto list = [&](Index c) {
    if (c >= mesh_.n_owned || layer_of_[c] > 0 || stamp_[c] == calls_) return;
    stamp_[c] = calls_;
    layer_.push_back(c);
  };
  for (const Index c : set_)
    if (layer_of_[c] >= layer - 2)
      for (const Index n : mesh_.cell_neighbours[c]) list(n);
  for (Index c = mesh_.n_owned; c < mesh_.n_cells; ++c)
    if (layer_of_[c] > 0)
      for (const Index n : known.around_halo()[c - mesh_.n_owned]) list(n);
}

void Extension::fill(CellField<SymTensor>& T, Real layer) {
  values_.clear();
  for (const Index c : layer_) {
    SymTensor sum;
    Real weights = 0;
    for (Index i = mesh_.cell_neighbours.offset[c]; i < mesh_.cell_neighbours.offset[c + 1]; ++i) {
      const Index n = mesh_.cell_neighbours.index[i];
      if (layer_of_[n] == 0) continue;
      const Vec3 x = mesh_.C[n] + mesh_.translation[mesh_.cell_neighbour_shift[i]];
      const Real w = 1 / norm2(x - mesh_.C[c]);
      sum += w * T[n];
      weights += w;
    }
    values_.push_back((1 / weights) * sum);
  }
  for (std::size_t i = 0; i < layer_.size(); ++i)
    T[layer_[i]] = values_[i], layer_of_[layer_[i]] = layer;
  mesh_.halo.update(T);
  mesh_.halo.update(layer_of_);
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
  for (std::size_t i = 0; i < outer_.size(); ++i) {
    const Index c = outer_[i];
    const Real keep = std::exp(-2 * norm(u[c] - u_s) * dt / h_[c]);
    T[c] += keep * (own_[i] - T[c]);
  }
}

void Extension::apply(CellField<SymTensor>& T, const CellField<Real>& alpha, const Band& known,
                      const CellField<Vec3>& u, Real dt) {
  sort(known);
  mesh_.halo.update(T);
  own_.clear();
  for (const Index c : outer_) own_.push_back(T[c]);
  layer_ = outer_;
  fill(T, outer_layer);
  if (dt > 0) {
    relax(T, u, mean(u, alpha, known), dt);
  } else {
    for (std::size_t i = 0; i < outer_.size(); ++i) T[outer_[i]] = own_[i];
  }
  mesh_.halo.update(T);
  constexpr int rings = 3;
  for (int ring = 1; ring <= rings; ++ring) {
    list_ring(outer_layer + ring, known);
    fill(T, outer_layer + ring);
    inside_ = set_.size();
    set_.insert(set_.end(), layer_.begin(), layer_.end());
  }
  for (const Index c : last_set_)
    if (layer_of_[c] == 0) T[c] = {};
  mesh_.halo.update(T);
}

}  // namespace fsi::solid
