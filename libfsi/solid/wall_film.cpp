#include "libfsi/solid/wall_film.hpp"

#include <algorithm>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/extension.hpp"

namespace fsi::solid {

WallFilm::WallFilm(const Mesh& mesh, const std::vector<Patch>& walls,
                   const std::vector<char>& bonded)
    : mesh_(mesh),
      at_film_(mesh),
      known_(mesh),
      fraction_(mesh),
      faces_(static_cast<std::size_t>(mesh.n_boundary()), 0) {
  CellField<Real> held(mesh);
  for (const Patch& patch : walls)
    for (Index f = patch.begin; f < patch.end; ++f) {
      at_film_[mesh.owner[f]] = 1;
      if (bonded[f - mesh.n_internal] != 0) held[mesh.owner[f]] = 1;
    }
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (held[c] > 0) at_film_[c] = 0;
  mesh.halo.update(at_film_);
  for (const Patch& patch : walls)
    for (Index f = patch.begin; f < patch.end; ++f)
      if (at_film(mesh.owner[f])) faces_[f - mesh.n_internal] = 1;
  const auto is_at = [&](Index n) { return at_film(n); };
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (is_at(c))
      at_.push_back(c);
    else if (std::ranges::any_of(mesh.cell_neighbours[c], is_at))
      beside_.push_back(c);
}

void WallFilm::set(const CellField<Real>& fraction) {
  const auto of_solid = [&](Index c) { return fraction[c] >= alpha_known; };
  fraction_.assign(fraction);
  // A cell is known only if a face neighbour has alpha of at least 1/2 too (Extension).
  for (const Index c : beside_)
    known_[c] = of_solid(c) && std::ranges::any_of(mesh_.cell_faces[c], [&](Index f) {
                  const Index n = beyond(mesh_, f, c);
                  return n >= 0 && !at_film(n) && of_solid(n);
                });
  mesh_.halo.update(known_);
  for (const Index c : at_)
    if (of_solid(c) &&
        std::ranges::any_of(mesh_.cell_neighbours[c], [&](Index n) { return known_[n] > 0; }))
      fraction_[c] = 0;
  mesh_.halo.update(fraction_);
}

bool WallFilm::covers(Index f, const CellField<Real>& alpha) const {
  constexpr Real wisp = 1e-9;  // around less solid alpha_f is not set
  return faces_[f - mesh_.n_internal] != 0 && alpha[mesh_.owner[f]] >= wisp;
}

void WallFilm::set_viscosity(FaceField<Real>& mu, const CellField<Real>& alpha, Real mu_f) const {
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f)
    if (covers(f, alpha)) mu[f] = mu_f;
}

void WallFilm::thin(FaceField<Real>& mu, const CellField<Real>& alpha,
                    const FaceField<Real>& alpha_f, Real mu_f) const {
  constexpr Real least = 1e-9;  // of the depth
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f)
    if (covers(f, alpha)) mu[f] = mu_f / std::max(mu_f / mu[f] - alpha_f[f], least);
}

void WallFilm::bound_viscosity(FaceField<Real>& mu, const CellField<Real>& alpha, Real mu_f,
                               Real thickness) const {
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f)
    if (covers(f, alpha)) mu[f] = std::min(mu[f], mu_f * depth(f) / thickness);
}

Real WallFilm::depth(Index f) const { return dot(mesh_.d[f], mesh_.Sf[f]) / norm(mesh_.Sf[f]); }

Real WallFilm::largest_depth() const {
  Real largest = 0;
  for (Index f = mesh_.n_internal; f < mesh_.n_faces; ++f)
    if (faces_[f - mesh_.n_internal] != 0) largest = std::max(largest, depth(f));
  return global_max(largest);
}

}  // namespace fsi::solid
