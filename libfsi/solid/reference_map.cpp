#include "libfsi/solid/reference_map.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/eigen.hpp"
#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/koren.hpp"

namespace fsi::solid {
namespace {

Real largest_rate(const Tensor& L) {
  return std::max({2 * std::abs(L.xx), 2 * std::abs(L.yy), 2 * std::abs(L.zz),
                   std::abs(L.xy + L.yx), std::abs(L.xz + L.zx), std::abs(L.yz + L.zy)});
}

}  // namespace

ReferenceMap::ReferenceMap(const Mesh& mesh)
    : d(mesh),
      is_set(mesh, 1),
      mesh_(mesh),
      stencil_(mesh, FaceWeights(mesh), std::vector<bool>(mesh.patches.size(), false)),
      known_(mesh),
      extension_(mesh),
      filled_(mesh),
      slope_(mesh) {}

void ReferenceMap::set_undeformed(const CellField<Real>& alpha) {
  d.fill({});
  is_set.fill(1);
  resume(alpha);
}

void ReferenceMap::set(Index /*c*/, const SymTensor& /*B*/, Real /*alpha*/) {
  throw Error(Kind::input, "reference_map: B alone does not tell a map; give the map itself");
}

void ReferenceMap::resume(const CellField<Real>& alpha) {
  mark(alpha);
  extend();
}

void ReferenceMap::mark(const CellField<Real>& alpha) {
  for (Index c = 0; c < mesh_.n_cells; ++c) filled_[c] = is_set[c] > 0 ? alpha[c] : 0;
  known_.rebuild(filled_, alpha_known);
}

Tensor ReferenceMap::gradient_of_map(Index c) const {
  Tensor g = slope_[c];
  g.xx += 1, g.yy += 1, g.zz += 1;
  return g;
}

void ReferenceMap::extend() {
  for (const Index c : extension_.inside()) slope_[c] = {};
  for (const Index c : extension_.last_ring()) slope_[c] = {};
  extension_.apply(d, is_set, known_);
  for (const Index c : extension_.inside()) {
    Tensor sum;
    for (const Index f : mesh_.cell_faces[c]) {
      if (f >= mesh_.n_internal) continue;
      const bool owner = mesh_.owner[f] == c;
      const Index n = owner ? mesh_.neighbour[f] : mesh_.owner[f];
      sum += outer(d[n] - d[c], owner ? stencil_.owner[f] : stencil_.neighbour[f]);
    }
    slope_[c] = sum;
  }
  for (const Index c : extension_.last_ring()) slope_[c] = extension_.slope(c);
  mesh_.halo.update(slope_);
}

Vec3 ReferenceMap::face_value(Index f, Index c, const Carrier& carrier, Real dt) const {
  // Within dt particles of the upwind cell pass; the middle one was dt / 2 away:
  //   d_f = d_up + limited + grad d . skew - dt / 2 (u + grad d . u)_up
  const FaceWeights& weights = carrier.weights;
  if (f >= mesh_.n_internal) return d[c] + dot(slope_[c], mesh_.Cf[f] - mesh_.C[c]);
  const Index P = mesh_.owner[f], N = mesh_.neighbour[f];
  const bool forward = carrier.phi[f] >= 0;
  const Index up = forward ? P : N, down = forward ? N : P;
  const Real share = forward ? weights.lambda[f] : 1 - weights.lambda[f];
  const Vec3 way = forward ? mesh_.d[f] : -mesh_.d[f];
  const Vec3 u = carrier.u[up];
  Vec3 face = d[up] + (2 * share) * koren(d[down] - d[up], dot(slope_[up], way));
  if (weights.skewed) face += dot(slope_[up], weights.skew[f]);
  return face - (dt / 2) * (u + dot(slope_[up], u));
}

Real ReferenceMap::transport(const CellField<Real>& /*alpha*/, const Carrier& carrier, Real dt,
                             CellField<SymGradient>& /*grad*/) {
  new_.clear();
  Real fastest = 0;
  for (const Index c : known_.core()) {
    // -(1/V) sum_f phi_f (xi_f - xi_c),  xi = x + d
    Vec3 sum;
    for (const Index f : mesh_.cell_faces[c]) {
      const bool outward = f >= mesh_.n_internal || mesh_.owner[f] == c;
      const Real phi = outward ? carrier.phi[f] : -carrier.phi[f];
      const Vec3 xi = mesh_.face_centre(f, c) - mesh_.C[c] + face_value(f, c, carrier, dt);
      sum += phi * (xi - d[c]);
    }
    new_.push_back(d[c] - (dt / mesh_.V[c]) * sum);
    fastest = std::max(fastest, largest_rate(carrier.L[c]));
  }
  const std::vector<Index>& core = known_.core();
  for (std::size_t i = 0; i < core.size(); ++i) d[core[i]] = new_[i];
  extend();
  if (!all_of_ranks(!folded()))
    throw Error(Kind::numerics, "the reference map folds: det grad xi <= 0");
  return fastest;
}

bool ReferenceMap::folded() const {
  return std::ranges::any_of(known_.core(), [&](Index c) { return !(volume_ratio(c) > 0); });
}

Real ReferenceMap::weigh(CellField<SymTensor>& aB, CellField<Real>& lambda,
                         const CellField<Real>& alpha, std::span<const Index> cells) const {
  Real least = 1;
  for (const Index c : cells) {
    const SymTensor b = B(c, alpha[c]);
    const Eigen e = eigen(b);
    least = std::min(least, e.value[0]);
    aB[c] = alpha[c] * b;
    lambda[c] = alpha[c] * e.value[2];
  }
  return least;
}

SymTensor ReferenceMap::B(Index c, Real /*alpha*/) const {
  // B = (grad xi)^-1 (grad xi)^-T / det^(1/dim) of the same
  const Tensor A = gradient_of_map(c);
  const Real J = det(A);
  if (!(J > 0)) return identity();
  const Tensor F = inverse(A);
  const Vec3 x{F.xx, F.xy, F.xz}, y{F.yx, F.yy, F.yz}, z{F.zx, F.zy, F.zz};
  const SymTensor b{dot(x, x), dot(x, y), dot(x, z), dot(y, y), dot(y, z), dot(z, z)};
  if (mesh_.dim == 2) return {J * b.xx, J * b.xy, 0, J * b.yy, 0, 1};
  return std::cbrt(J * J) * b;
}

}  // namespace fsi::solid
