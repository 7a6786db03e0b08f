#include "libfsi/vof/bend.hpp"

#include <cmath>

#include "libfsi/core/parallel.hpp"
#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::vof {
namespace {

/// The part of L along the plane of normal n, symmetric.
SymTensor along_plane(const Tensor& L, const Vec3& n) {
  const SymTensor S{L.xx, (L.xy + L.yx) / 2, (L.xz + L.zx) / 2, L.yy, (L.yz + L.zy) / 2, L.zz};
  const Vec3 Sn = dot(S, n);
  return S - both_ways(Sn, n) + dot(n, Sn) * square(n);
}

}  // namespace

bool bends(const Mesh& mesh, Index c) { return mesh.dim == 3 && mesh.simplex(c); }

bool any_cell_bends(const Mesh& mesh) {
  Real any = 0;
  for (Index c = 0; c < mesh.n_owned; ++c)
    if (bends(mesh, c)) any = 1;
  return global_max(any) > 0;
}

void set_bend(CellField<Bend>& bend, const Interface& interface, const Mesh& mesh,
              const SymmetryFaces& symmetry, geometry::Polytope& cell) {
  constexpr Real same_side = 0.5, told = 1e-2;
  for (const Index c : interface.cells) {
    if (!bends(mesh, c)) continue;
    const Piece& p = interface.piece[c];
    // All planes have the same weight: the normals of near ones differ by their errors.
    SlopeFit fit;
    const auto add = [&](const Vec3& centre, const Vec3& n_hat) {
      const Vec3 r = centre - p.centre, along = r - dot(r, p.n_hat) * p.n_hat;
      if (dot(p.n_hat, n_hat) < same_side || !(norm2(along) > 0)) return;
      fit.M += square(along), fit.R += outer(n_hat - p.n_hat, along);
    };
    for_neighbours_and_images(c, symmetry, mesh, [&](Index k, const Vec3& r, const Reflection& of) {
      const Piece& q = interface.piece[k];
      if (q.area > 0) add(mesh.C[c] + r + image(q.centre - mesh.C[k], of), image(q.n_hat, of));
    });
    SymTensor K = along_plane(fit.slope(told), p.n_hat);
    const Real size = std::sqrt(contract(K, K)), most = 1 / cell_size(mesh, c);
    if (size > most) K *= most / size;
    gather(cell, mesh, c);
    const geometry::Cut cut = geometry::cut(cell, {p.n_hat, dot(p.n_hat, p.centre - mesh.C[c])});
    bend[c] = {K, contract(K, cut.spread)};
  }
  mesh.halo.update(bend);
}

}  // namespace fsi::vof
