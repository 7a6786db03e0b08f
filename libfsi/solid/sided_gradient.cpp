#include "libfsi/solid/sided_gradient.hpp"

#include <algorithm>
#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/one_sided.hpp"
#include "libfsi/solid/quadratic_fit.hpp"

namespace fsi::solid {
namespace {

/// The fit about c over the neighbours n with same(n), with their L where has_L(n).
template <class Same, class HasL>
std::optional<Tensor> fit(const CellField<Tensor>& L, const CellField<Vec3>& u,
                          const BoundaryField<Vec3>& u_b, const Same& same, const HasL& has_L,
                          const Mesh& mesh, Index c) {
  QuadraticFit quadratic(mesh.dim, mesh.dim == 2 ? std::sqrt(mesh.V[c]) : std::cbrt(mesh.V[c]));
  for (Index k = mesh.cell_neighbours.offset[c]; k < mesh.cell_neighbours.offset[c + 1]; ++k) {
    const Index n = mesh.cell_neighbours.index[k];
    if (!same(n)) continue;
    const Vec3 r = mesh.C[n] - mesh.C[c] + mesh.translation[mesh.cell_neighbour_shift[k]];
    quadratic.add_value(r, u[n] - u[c]);
    if (has_L(n)) quadratic.add_gradient(r, L[n]);
  }
  for (const Index f : mesh.cell_faces[c])
    if (f >= mesh.n_internal) quadratic.add_value(mesh.d[f], u_b[f - mesh.n_internal] - u[c]);
  return quadratic.gradient();
}

}  // namespace

bool has_simplices(const Mesh& mesh) {
  bool none = true;
  for (Index c = 0; c < mesh.n_owned; ++c)
    none = none && static_cast<int>(mesh.cell_faces[c].size()) > mesh.dim + 1;
  return !all_of_ranks(none);
}

void SidedGradient::apply(CellField<Tensor>& L, const CellField<Vec3>& u,
                          const BoundaryField<Vec3>& u_b, const CellField<Real>& alpha,
                          std::span<const Index> cells) {
  const auto known = [&](Index c) { return alpha[c] >= alpha_known; };
  const auto none = [](Index) { return false; };
  for (const Index c : last_deep_) deep_[c] = 0;
  last_deep_.clear();
  for (const Index c : cells) {
    if (!known(c) || !std::ranges::all_of(mesh_.cell_neighbours[c], known)) continue;
    const auto whole = fit(L, u, u_b, known, none, mesh_, c);
    if (!whole) continue;
    L[c] = *whole;
    deep_[c] = 1;
    last_deep_.push_back(c);
  }
  mesh_.halo.update(deep_);
  mesh_.halo.update(L);
  const auto deep = [&](Index c) { return deep_[c] > 0; };
  for (const Index c : cells) {
    if (deep(c)) continue;
    const bool in = known(c);
    const auto same = [&](Index n) { return known(n) == in; };
    const auto sided = fit(L, u, u_b, same, deep, mesh_, c);
    L[c] = sided ? *sided : one_sided_gradient(L, u, same, none, mesh_, c);
  }
  mesh_.halo.update(L);
}

}  // namespace fsi::solid
