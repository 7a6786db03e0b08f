#include "libfsi/solid/interface_gradient.hpp"

#include <algorithm>

#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/one_sided.hpp"

namespace fsi::solid {
namespace {

/// The velocity of one side of the surface: u without the share of the kink in cut cells.
struct OfOneSide {
  const CellField<Vec3>& u;
  const CellField<Vec3>& kink;
  Vec3 operator[](Index c) const { return u[c] - kink[c]; }
};

/// The velocity that a wall or an inlet gives at a face; null where none does.
struct OfWalls {
  const BoundaryField<Vec3>& u_b;
  const BoundarySides& sides;
  const Mesh& mesh;
  const Vec3* operator()(Index f) const {
    const Index b = f - mesh.n_internal;
    return b < 0 || (!sides.given.empty() && sides.given[b] == 0) ? nullptr : &u_b[b];
  }
};

/// The fit about c to the u of vertex neighbours n with same(n), and to their L if has_L(n).
template <class Velocity, class Same, class HasL>
std::optional<Tensor> fit(const CellField<Tensor>& L, const Velocity& u, const OfWalls& walls,
                          const Same& same, const HasL& has_L, const Mesh& mesh, Index c) {
  QuadraticFit quadratic(mesh.dim, cell_size(mesh, c));
  const Vec3 u_c = u[c];
  const SymmetryFaces& symmetry = walls.sides.symmetry;
  for_neighbours_and_images(c, symmetry, mesh, [&](Index k, const Vec3& r, const Reflection& n) {
    if (!same(k)) return;
    quadratic.add_value(r, image(u[k], n) - u_c);
    if (has_L(k)) quadratic.add_gradient(r, image(L[k], n));
  });
  for (const Index f : mesh.cell_faces[c])
    if (const Vec3* u_f = walls(f)) quadratic.add_value(mesh.d[f], *u_f - u_c);
  return quadratic.gradient();
}

}  // namespace

InterfaceGradient::InterfaceGradient(const Mesh& mesh, const SimplexZone& zone, BoundarySides sides)
    : mesh_(mesh),
      zone_(zone),
      sides_(std::move(sides)),
      deep_(mesh),
      strain_(mesh),
      kink_in_(mesh),
      kink_out_(mesh) {
  CellField<Real> at_wall(mesh);
  for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
    if (sides_.given.empty() || sides_.given[f - mesh.n_internal] != 0) at_wall[mesh.owner[f]] = 1;
  mesh.halo.update(at_wall);
  const auto touches = [&](Index c) { return at_wall[c] > 0; };
  for (Index c = 0; c < mesh.n_owned; ++c)
    near_wall_.push_back(touches(c) || std::ranges::any_of(mesh.cell_neighbours[c], touches) ? 1
                                                                                             : 0);
}

void InterfaceGradient::apply(CellField<Tensor>& L, const CellField<Vec3>& u,
                              const BoundaryField<Vec3>& u_b, const Cuts& cuts,
                              std::span<const Index> cells) {
  clear_kinks();
  fit_cells(L, u, u_b, cuts.alpha, cells);
  set_kinks(L, cuts, cells);
  fit_cells(L, u, u_b, cuts.alpha, cells);
}

void InterfaceGradient::clear_kinks() {
  for (const Index c : kinked_) kink_in_[c] = kink_out_[c] = {};
  kinked_.clear();
  mesh_.halo.update(kink_in_);
  mesh_.halo.update(kink_out_);
}

void InterfaceGradient::set_kinks(const CellField<Tensor>& L, const Cuts& cuts,
                                  std::span<const Index> cells) {
  for (const Index c : cells) {
    const Vec3& n = cuts.normal[c];
    if (norm2(n) == 0 || !zone_.near(c)) continue;
    Tensor in, out;
    Real w_in = 0, w_out = 0;
    for_neighbours_and_images(c, sides_.symmetry, mesh_,
                              [&](Index k, const Vec3& /*r*/, const Reflection& plane) {
                                const Real alpha = cuts.alpha[k];
                                if (alpha >= alpha_known)
                                  in += alpha * image(L[k], plane), w_in += alpha;
                                else
                                  out += (1 - alpha) * image(L[k], plane), w_out += 1 - alpha;
                              });
    if (!(w_in > 0 && w_out > 0)) continue;
    const Vec3 jump = dot((1 / w_out) * out + (-1 / w_in) * in, n);
    const Vec3 along = jump - dot(jump, n) * n;
    kink_in_[c] = cuts.solid_side[c] * along;
    kink_out_[c] = cuts.fluid_side[c] * along;
    kinked_.push_back(c);
  }
  mesh_.halo.update(kink_in_);
  mesh_.halo.update(kink_out_);
}

void InterfaceGradient::fit_cells(CellField<Tensor>& L, const CellField<Vec3>& u,
                                  const BoundaryField<Vec3>& u_b, const CellField<Real>& alpha,
                                  std::span<const Index> cells) {
  const auto known = [&](Index c) { return alpha[c] >= alpha_known; };
  const auto none = [](Index) { return false; };
  const OfOneSide u_in{u, kink_in_}, u_out{u, kink_out_};
  const OfWalls walls{u_b, sides_, mesh_};
  for (const Index c : last_deep_) deep_[c] = 0;
  last_deep_.clear();
  for (const Index c : cells) {
    if (!zone_.has(c) || !known(c) || !std::ranges::all_of(mesh_.cell_neighbours[c], known))
      continue;
    const auto whole = fit(L, u_in, walls, known, none, mesh_, c);
    if (!whole) continue;
    L[c] = *whole;
    deep_[c] = 1;
    last_deep_.push_back(c);
  }
  mesh_.halo.update(deep_);
  mesh_.halo.update(L);
  const auto deep = [&](Index c) { return deep_[c] > 0; };
  for (const Index c : cells) {
    if (!zone_.has(c) || deep(c)) continue;
    const bool in = known(c);
    const auto same = [&](Index n) { return known(n) == in; };
    const auto sided =
        in ? fit(L, u_in, walls, same, deep, mesh_, c) : fit(L, u_out, walls, same, none, mesh_, c);
    if (sided) L[c] = *sided;
  }
  mesh_.halo.update(L);
}

void InterfaceGradient::set_strain(const CellField<Tensor>& L, const CellField<Vec3>& u,
                                   const BoundaryField<Vec3>& u_b, const CellField<Real>& alpha,
                                   std::span<const Index> cells) {
  const auto known = [&](Index c) { return alpha[c] >= alpha_known; };
  const auto deep = [&](Index c) { return deep_[c] > 0; };
  const auto set = [&](Index c) { return zone_.near(c); };
  const OfWalls walls{u_b, sides_, mesh_};
  const OfOneSide u_in{u, kink_in_};
  beside_.clear();
  for (const Index c : cells) {
    if (!zone_.near(c) || !known(c)) continue;
    strain_[c] = L[c];
    if (!deep(c) && near_wall_[c] == 0) beside_.push_back(c);
  }
  mesh_.halo.update(strain_);
  constexpr int sweeps = 4;
  for (int i = 0; i < sweeps; ++i) {
    swept_.clear();
    for (const Index c : beside_)
      swept_.push_back(
          i == 0 ? one_sided_gradient(strain_, u_in, known, deep, walls, mesh_, c, sides_.symmetry)
                 : one_sided_gradient(strain_, u_in, known, set, walls, mesh_, c, sides_.symmetry));
    for (std::size_t k = 0; k < beside_.size(); ++k) strain_[beside_[k]] = swept_[k];
    mesh_.halo.update(strain_);
  }
}

}  // namespace fsi::solid
