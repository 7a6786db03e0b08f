#include "libfsi/solid/extension.hpp"

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
    : mesh_(mesh), zone_(mesh), ring_of_(mesh), stamp_(static_cast<std::size_t>(mesh.n_owned), 0) {}

void Extension::mark(const CellField<Real>& alpha, const Band& known) {
  for (const Index c : near_) zone_[c] = 0;
  near_ = set_;
  near_.insert(near_.end(), known.cells().begin(), known.cells().end());
  for (const Index c : near_) zone_[c] = 1;
  for (const Index c : known.core())
    if (is_inner(c, alpha, mesh_)) zone_[c] = 2;
  mesh_.halo.update(zone_);
}

void Extension::list_ring(Real ring, const Band& known) {
  ++calls_;
  ring_.clear();
  const auto list = [&](Index c) {
    if (c >= mesh_.n_owned || ring_of_[c] > 0 || stamp_[c] == calls_) return;
    stamp_[c] = calls_;
    ring_.push_back(c);
  };
  for (const Index c : set_)
    if (ring_of_[c] >= ring - 1)
      for (const Index n : mesh_.cell_neighbours[c]) list(n);
  for (Index c = mesh_.n_owned; c < mesh_.n_cells; ++c)
    if (ring_of_[c] > 0)
      for (const Index n : known.around_halo()[c - mesh_.n_owned]) list(n);
}

void Extension::fill(CellField<SymTensor>& T, Real ring) {
  values_.clear();
  for (const Index c : ring_) {
    SymTensor sum;
    Real weights = 0;
    for (Index i = mesh_.cell_neighbours.offset[c]; i < mesh_.cell_neighbours.offset[c + 1]; ++i) {
      const Index n = mesh_.cell_neighbours.index[i];
      if (ring_of_[n] == 0) continue;
      const Vec3 x = mesh_.C[n] + mesh_.translation[mesh_.cell_neighbour_shift[i]];
      const Real w = 1 / norm2(x - mesh_.C[c]);
      sum += w * T[n];
      weights += w;
    }
    values_.push_back((1 / weights) * sum);
  }
  for (std::size_t i = 0; i < ring_.size(); ++i)
    T[ring_[i]] = values_[i], ring_of_[ring_[i]] = ring;
  mesh_.halo.update(ring_of_);
  mesh_.halo.update(T, ring_of_);
}

void Extension::apply(CellField<SymTensor>& T, const Band& known) {
  for (const Index c : set_) ring_of_[c] = 0;
  last_set_.swap(set_);
  set_ = known.core();
  for (const Index c : set_) ring_of_[c] = 1;
  mesh_.halo.update(ring_of_);
  mesh_.halo.update(T, ring_of_);
  constexpr int rings = 3;
  for (int ring = 1; ring <= rings; ++ring) {
    list_ring(1 + ring, known);
    fill(T, 1 + ring);
    inside_ = set_.size();
    set_.insert(set_.end(), ring_.begin(), ring_.end());
  }
  for (const Index c : last_set_)
    if (ring_of_[c] == 0) T[c] = {};
}

}  // namespace fsi::solid
