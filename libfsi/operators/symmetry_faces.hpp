#pragma once
// Images of cells beyond planes of symmetry, and of their values.

#include <vector>

#include "libfsi/geometry/mirror.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/stencil.hpp"

namespace fsi {

/// The boundary faces on planes of symmetry beyond which the images of cells count as neighbours.
struct SymmetryFaces {
  std::vector<char> is{};  ///< [n_boundary] 1 for these, else 0; empty: there are none

  /// Whether f is one of them.
  bool has(Index f, const Mesh& mesh) const {
    return !is.empty() && f >= mesh.n_internal && is[f - mesh.n_internal] != 0;
  }
};

/// Image of a vector in a plane with unit normal n: R v, R = I - 2 n (x) n.
inline Vec3 image(const Vec3& v, const Vec3& n) { return geometry::Mirror{{}, n}.of_direction(v); }
/// Image of the gradient of a field of vectors: R g R.
inline Tensor image(const Tensor& g, const Vec3& n) {
  const Vec3 x = image(Vec3{g.xx, g.xy, g.xz}, n), y = image(Vec3{g.yx, g.yy, g.yz}, n),
             z = image(Vec3{g.zx, g.zy, g.zz}, n);  // rows of g R
  const Tensor gR{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
  return gR + outer(-2 * n, n.x * x + n.y * y + n.z * z);
}

/// Image of a tensor: R T R.
inline SymTensor image(const SymTensor& T, const Vec3& n) {
  if (n == Vec3{}) return T;                              // a neighbour, as most are
  const Vec3 t = dot(T, n), s = 2 * (dot(n, t) * n - t);  // R T R = T + s n + n s
  return {T.xx + 2 * s.x * n.x, T.xy + s.x * n.y + n.x * s.y, T.xz + s.x * n.z + n.x * s.z,
          T.yy + 2 * s.y * n.y, T.yz + s.y * n.z + n.y * s.z, T.zz + 2 * s.z * n.z};
}

/// Calls f(k, r, n) for the images of owned cell c and of its vertex neighbours in each plane of
/// symmetry on which c has a face. n is the normal of the plane, and r leads from the centre of c
/// to that of the image of k. Only cells next to the plane count: their centre is less than 2.5
/// times as far from it as that of c. Between a prism with a face on the plane and one with an edge
/// on it the factor is 2, and to the next layer of hexahedra 3. For a triangle or tetrahedron c the
/// factor is 3.5: cells with only a corner on the plane are up to three times as far away.
template <class Function>
void for_images(Index c, const SymmetryFaces& symmetry, const Mesh& mesh, Function&& f) {
  const Real reach = mesh.simplex(c) ? 3.5 : 2.5;
  for (const Index face : mesh.cell_faces[c]) {
    if (!symmetry.has(face, mesh)) continue;
    const Vec3 n = mesh.Sf[face] / norm(mesh.Sf[face]);
    const Real own = dot(mesh.Cf[face] - mesh.C[c], n);
    f(c, (2 * own) * n, n);
    for_vertex_neighbours(c, mesh, [&](Index k, const Vec3& r) {
      const Real height = own - dot(r, n);
      if (height > 0 && height < reach * own) f(k, r + (2 * height) * n, n);
    });
  }
}

/// Calls f(k, r, n) for the vertex neighbours k of owned cell c, with n = 0, and for the images of
/// `for_images`. image(q, n) is then the value that c sees: q itself of a neighbour.
template <class Function>
void for_neighbours_and_images(Index c, const SymmetryFaces& symmetry, const Mesh& mesh,
                               Function&& f) {
  for_vertex_neighbours(c, mesh, [&](Index k, const Vec3& r) { f(k, r, Vec3{}); });
  for_images(c, symmetry, mesh, f);
}

}  // namespace fsi
