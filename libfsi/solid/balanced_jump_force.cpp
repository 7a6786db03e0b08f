#include "libfsi/solid/balanced_jump_force.hpp"

#include "libfsi/operators/stencil.hpp"

namespace fsi::solid {

BalancedJumpForce::BalancedJumpForce(const Mesh& mesh, const FaceWeights& weights)
    : mesh_(mesh), first_(mesh), whole_(mesh), at_faces_(weights.irregular.size()) {
  if (weights.uneven) around_.emplace(mesh);
}

void BalancedJumpForce::clear() {
  for (const std::vector<Index>* faces : {&faces_, &reached_})
    for (const Index f : *faces) {
      const Index P = mesh_.owner[f], N = f < mesh_.n_internal ? mesh_.neighbour[f] : P;
      first_[P] = whole_[P] = first_[N] = whole_[N] = {};
    }
  faces_.clear();
}

void BalancedJumpForce::add(Index f, Real J, const GradientStencil& stencil) {
  const Index P = mesh_.owner[f];
  faces_.push_back(f);
  first_[P] += J * stencil.owner[f];
  if (f >= mesh_.n_internal) {
    if (stencil.given[f - mesh_.n_internal] != 0) whole_[P] += (J / mesh_.V[P]) * mesh_.Sf[f];
    return;
  }
  const Index N = mesh_.neighbour[f];
  const Real lambda = stencil.weights.lambda[f];
  first_[N] -= J * stencil.neighbour[f];
  whole_[P] += (lambda * J / mesh_.V[P]) * mesh_.Sf[f];
  whole_[N] += ((1 - lambda) * J / mesh_.V[N]) * mesh_.Sf[f];
}

void BalancedJumpForce::add_irregular(const GradientStencil& stencil, const Band& band) {
  const FaceWeights& weights = stencil.weights;
  for (const Index f : band.faces()) {
    const Index i = weights.place[f], P = mesh_.owner[f];
    if (i < 0) continue;
    if (f < mesh_.n_internal) {
      const Index N = mesh_.neighbour[f];
      const Vec3 rest = dot(at_faces_[i], weights.skew[f]) * mesh_.Sf[f];
      whole_[P] += (1 / mesh_.V[P]) * rest;
      whole_[N] -= (1 / mesh_.V[N]) * rest;
    } else if (stencil.given[f - mesh_.n_internal] == 0 && !mesh_.brick(P)) {
      const Vec3 e = stencil.to_boundary(f, mesh_);
      whole_[P] += (dot(at_faces_[i], e) / mesh_.V[P]) * mesh_.Sf[f];
    }
  }
}

void BalancedJumpForce::apply(CellField<Vec3>& force, FaceField<Real>& rhie_chow_source,
                              PressureStencil& pressure, const Band& of_rises) {
  const GradientStencil& stencil = pressure.cells;
  const FaceWeights& weights = stencil.weights;
  constexpr Real listed = 0.5;
  if (around_) around_->rebuild(of_rises.listed(), listed);
  const Band& band = around_ ? *around_ : of_rises;
  mesh_.halo.update(first_);  // whole halo: the outermost rises also add to cells beyond the band
  reached_ = band.faces();
  pressure.at_faces.set(at_faces_, first_, band);
  add_irregular(stencil, band);
  for (std::size_t i = 0; i < stencil.closed.size(); ++i) {
    const Index c = stencil.closed_cells[i];
    if (band.listed()[c] != 0) whole_[c] = dot(stencil.closed[i], whole_[c]);
  }
  // Cells beyond the band have only a part of the sum over their faces, and this part depends on
  // the ranks. So the force and c_f leave them out.
  for (const Index f : reached_) {
    const Index P = mesh_.owner[f], N = f < mesh_.n_internal ? mesh_.neighbour[f] : P;
    for (const Index c : {P, N})
      if (band.listed()[c] == 0) whole_[c] = {};
  }
  mesh_.halo.update(whole_);
  for (const Index c : band.cells()) force[c] += whole_[c];
  for (const Index f : band.faces()) {
    if (f >= mesh_.n_internal) continue;
    Real along = dot(mirror_mean(whole_, f, weights, mesh_), mesh_.Sf[f]);
    if (const Index i = weights.place[f]; i >= 0) along -= dot(at_faces_[i], weights.k[f]);
    rhie_chow_source[f] -= along / weights.g[f];
  }
}

}  // namespace fsi::solid
