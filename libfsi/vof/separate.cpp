#include "libfsi/vof/separate.hpp"

#include <algorithm>
#include <limits>

#include "libfsi/core/parallel.hpp"
#include "libfsi/field/band.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi::vof {
namespace {

constexpr Real too_much = 1e-12;  // excess that is not moved

Real sum(std::span<const Fractions> bodies, Index c) {
  Real total = 0;
  for (const Fractions& body : bodies) total += (*body.alpha)[c];
  return total;
}

Real room(std::span<const Fractions> bodies, Index c) {
  return std::max(Real{0}, 1 - sum(bodies, c));
}

}  // namespace

Separation::Separation(const Mesh& mesh, std::size_t bodies)
    : mesh_(mesh), rim_(faces_between_ranks(mesh)) {
  for (std::size_t i = 0; i < bodies; ++i) rate_.emplace_back(mesh);
}

void Separation::offer(std::span<const Fractions> bodies, Index c) {
  const Real total = sum(bodies, c);
  if (!(total > 1 + too_much)) return;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const CellField<Real>& alpha = *bodies[i].alpha;
    if (alpha[c] <= 0) continue;
    Real open = 0, least = std::numeric_limits<Real>::max();
    for (const Index f : mesh_.cell_faces[c]) {
      const Index n = beyond(mesh_, f, c);
      if (n < 0) continue;
      const Real r = room(bodies, n);
      if (alpha[n] <= 0 || r <= 0) continue;
      open += r, least = std::min(least, mesh_.V[n]);
    }
    if (open <= 0) continue;
    // A cell takes of every body through all its faces, six at most, and must not overflow. What it
    // cannot take now stays for the next round.
    const Real most = 1 / (6 * static_cast<Real>(bodies.size()));
    const Real given = mesh_.V[c] * (total - 1) * alpha[c] / total;
    rate_[i][c] = std::min(given / open, most * least);
    givers_.push_back(c);
  }
}

void Separation::add_from(std::span<const Fractions> bodies, Index giver, Index n) {
  const Real r = room(bodies, n);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Real moved = rate_[i][giver] * r;
    if (moved <= 0 || (*bodies[i].alpha)[n] <= 0) continue;
    if (giver < mesh_.n_owned) moves_.push_back({giver, i, -moved});
    if (n < mesh_.n_owned) moves_.push_back({n, i, moved});
  }
}

bool Separation::apply(std::span<const Fractions> bodies, std::span<const Index> cells) {
  constexpr int rounds = 4;
  bool moved = false;
  for (int round = 0; round <= rounds; ++round) {
    overlap_ = 0;
    for (const Index c : cells) overlap_ = std::max(overlap_, sum(bodies, c) - 1);
    overlap_ = global_max(overlap_);
    if (overlap_ <= too_much || round == rounds) break;
    for (const Index c : givers_)
      for (CellField<Real>& rate : rate_) rate[c] = 0;
    givers_.clear(), moves_.clear();
    for (const Index c : cells) offer(bodies, c);
    for (CellField<Real>& rate : rate_) mesh_.halo.update(rate);
    Index last = -1;
    for (const Index c : givers_) {
      if (c == last) continue;  // listed once a body
      last = c;
      for (const Index f : mesh_.cell_faces[c])
        if (const Index n = beyond(mesh_, f, c); n >= 0) add_from(bodies, c, n);
    }
    for (const Index f : rim_) {
      const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
      add_from_halo(bodies, P, N), add_from_halo(bodies, N, P);
    }
    for (const Move& m : moves_) {
      const Real change = m.volume / mesh_.V[m.cell];
      (*bodies[m.body].alpha)[m.cell] += change;
      (*bodies[m.body].mid)[m.cell] += change / 2;
    }
    for (const Fractions& body : bodies) mesh_.halo.update(*body.alpha);
    moved = true;
  }
  if (moved)
    for (const Fractions& body : bodies) mesh_.halo.update(*body.mid);
  return moved;
}

void Separation::add_from_halo(std::span<const Fractions> bodies, Index giver, Index n) {
  if (giver >= mesh_.n_owned && n < mesh_.n_owned) add_from(bodies, giver, n);
}

}  // namespace fsi::vof
