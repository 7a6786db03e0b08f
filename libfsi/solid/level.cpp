#include "libfsi/solid/level.hpp"

namespace fsi::solid {

void Level::clear() {
  for (const Index f : faces_) {
    const Index P = mesh_.owner[f], N = f < mesh_.n_internal ? mesh_.neighbour[f] : P;
    first_[P] = whole_[P] = first_[N] = whole_[N] = {};
  }
  for (const Index c : cells_) whole_[c] = {};
  faces_.clear();
}

void Level::add(Index f, Real J, const FaceWeights& weights, const GradientStencil& stencil) {
  const Index P = mesh_.owner[f];
  faces_.push_back(f);
  first_[P] += J * stencil.owner[f];
  if (f >= mesh_.n_internal) {
    if (stencil.given[f - mesh_.n_internal] != 0) whole_[P] += (J / mesh_.V[P]) * mesh_.Sf[f];
    return;
  }
  const Index N = mesh_.neighbour[f];
  first_[N] -= J * stencil.neighbour[f];
  if (!weights.skewed) return;
  const Real lambda = weights.lambda[f];
  whole_[P] += (lambda * J / mesh_.V[P]) * mesh_.Sf[f];
  whole_[N] += ((1 - lambda) * J / mesh_.V[N]) * mesh_.Sf[f];
}

void Level::apply(CellField<Vec3>& force, FaceField<Real>& balance, const FaceWeights& weights,
                  const GradientStencil& stencil, const Band& band) {
  mesh_.halo.update(first_);  // all of it: cells beyond the band have a part of the outermost rises
  if (weights.skewed) {
    cells_ = band.cells();  // the neighbours of cells at a rise get a part as well
    add_skewness(whole_, first_, stencil, mesh_, band.cells());
    mesh_.halo.update(whole_);
  }
  const CellField<Vec3>& level = weights.skewed ? whole_ : first_;
  for (const Index c : band.cells()) force[c] += level[c];
  for (const Index f : band.faces()) {
    if (f >= mesh_.n_internal) continue;
    const Real lambda = weights.lambda[f];
    balance[f] -=
        dot((1 - lambda) * level[mesh_.owner[f]] + lambda * level[mesh_.neighbour[f]], mesh_.d[f]);
  }
}

}  // namespace fsi::solid
