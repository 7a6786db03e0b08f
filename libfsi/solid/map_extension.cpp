#include "libfsi/solid/map_extension.hpp"

#include "libfsi/solid/regression.hpp"

namespace fsi::solid {
namespace {

/// X with X M = R for a symmetric positive M.
Tensor slope_of(const Tensor& M, const Tensor& R, int dim) {
  return dot(R, inverse_of_moments(M, dim));
}

}  // namespace

MapExtension::MapExtension(const Mesh& mesh)
    : mesh_(mesh), item_(mesh), stamp_(static_cast<std::size_t>(mesh.n_owned), 0) {}

Tensor MapExtension::regression(Index c, Real up_to) const {
  Tensor M, R;
  for (Index i = mesh_.cell_neighbours.offset[c]; i < mesh_.cell_neighbours.offset[c + 1]; ++i) {
    const Index k = mesh_.cell_neighbours.index[i];
    if (item_[k].layer == 0 || item_[k].layer > up_to) continue;
    const Vec3 r = mesh_.C[k] + mesh_.translation[mesh_.cell_neighbour_shift[i]] - mesh_.C[c];
    const Real w = 1 / norm2(r);
    M += w * outer(r, r);
    R += w * outer(item_[k].d - item_[c].d, r);
  }
  return M == Tensor{} ? Tensor{} : slope_of(M, R, mesh_.dim);
}

MapExtension::Item MapExtension::fit(Index c, Real layer) const {
  // With W = sum w, m = sum w r / W and e = sum w d / W: d_c = e - g . m and
  //   g (sum w r (x) r - W m (x) m + n I) = sum w d (x) r - W e (x) m + sum g_k
  Real W = 0;
  Vec3 m, e;
  Tensor M, R;
  for (Index i = mesh_.cell_neighbours.offset[c]; i < mesh_.cell_neighbours.offset[c + 1]; ++i) {
    const Index k = mesh_.cell_neighbours.index[i];
    const Item& item = item_[k];
    if (item.layer == 0) continue;
    const Vec3 r = mesh_.C[k] + mesh_.translation[mesh_.cell_neighbour_shift[i]] - mesh_.C[c];
    const Real w = 1 / norm2(r);
    W += w, m += w * r, e += w * item.d;
    M += w * outer(r, r) + Tensor{1, 0, 0, 0, 1, 0, 0, 0, 1};
    R += w * outer(item.d, r) + item.g;
  }
  m *= 1 / W, e *= 1 / W;
  const Tensor g = slope_of(M + -W * outer(m, m), R + -W * outer(e, m), mesh_.dim);
  return {e - dot(g, m), g, layer};
}

void MapExtension::list_ring(Real layer, const Band& known) {
  ++calls_;
  ring_.clear();
  const auto list = [&](Index c) {
    if (c >= mesh_.n_owned || item_[c].layer > 0 || stamp_[c] == calls_) return;
    stamp_[c] = calls_;
    ring_.push_back(c);
  };
  for (const Index c : set_)
    if (item_[c].layer == layer - 1)
      for (const Index n : mesh_.cell_neighbours[c]) list(n);
  for (Index c = mesh_.n_owned; c < mesh_.n_cells; ++c)
    if (item_[c].layer > 0)
      for (const Index n : known.around_halo()[c - mesh_.n_owned]) list(n);
}

void MapExtension::apply(CellField<Vec3>& d, CellField<Real>& is_set, const Band& known) {
  for (const Index c : set_) item_[c] = {};
  last_set_.swap(set_);
  set_.assign(known.core().begin(), known.core().end());
  for (const Index c : set_) item_[c] = {d[c], {}, known_layer};
  mesh_.halo.update(item_);
  for (const Index c : set_) item_[c].g = regression(c, known_layer);
  mesh_.halo.update(item_);
  for (Real layer = known_layer + 1; layer <= last_layer; ++layer) {
    list_ring(layer, known);
    fitted_.clear();
    for (const Index c : ring_) fitted_.push_back(fit(c, layer));
    for (std::size_t i = 0; i < ring_.size(); ++i) item_[ring_[i]] = fitted_[i];
    mesh_.halo.update(item_);
    inside_ = set_.size();
    set_.insert(set_.end(), ring_.begin(), ring_.end());
  }
  for (const Index c : last_set_)
    if (item_[c].layer == 0) d[c] = {}, is_set[c] = 0;
  for (const Index c : set_) d[c] = item_[c].d, is_set[c] = 1;
  mesh_.halo.update(d);
  mesh_.halo.update(is_set);
}

}  // namespace fsi::solid
