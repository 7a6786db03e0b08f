#pragma once
// The velocity gradient on the solid's side of its surface.

#include "libfsi/core/eigen.hpp"
#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// L at owned cell c from the solid alone:
///   min over L of sum_n w |u_n - u_c - (L + L_n) / 2 . d|^2,  w = 1 / |d|^2,
/// over the vertex neighbours n with known(n), L in place of L_n where that is not inner(n): the
/// rule of the middle, exact for a quadratic u on the way to an inner neighbour; and, with L, over
/// the boundary faces f that have a velocity *u_at(f). In directions in which these do not spread,
/// L_c as it is given. L, u: owned and halo; u[c] a velocity.
template <class Velocity, class Known, class Inner, class BoundaryVelocity>
Tensor one_sided_gradient(const CellField<Tensor>& L, const Velocity& u, const Known& known,
                          const Inner& inner, const BoundaryVelocity& u_at, const Mesh& mesh,
                          Index c) {
  const Tensor& L_c = L[c];
  SymTensor M;
  Tensor rest;  // sum w (what L_c leaves of it) (x) d
  const auto add = [&](const Vec3& d, const Vec3& du) {
    const Real w = 1 / norm2(d);
    M += w * SymTensor{d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z};
    rest += outer(w * (du - dot(L_c, d)), d);
  };
  for (Index k = mesh.cell_neighbours.offset[c]; k < mesh.cell_neighbours.offset[c + 1]; ++k) {
    const Index n = mesh.cell_neighbours.index[k];
    if (!known(n)) continue;
    const Vec3 d = mesh.C[n] - mesh.C[c] + mesh.translation[mesh.cell_neighbour_shift[k]];
    const Vec3 du = u[n] - u[c];
    add(d, inner(n) ? 2 * du - dot(L[n], d) : du);
  }
  for (const Index f : mesh.cell_faces[c])
    if (const Vec3* u_f = f < mesh.n_internal ? nullptr : u_at(f)) add(mesh.d[f], *u_f - u[c]);
  constexpr Real flat = 0.05;  // part of the largest spread that counts as none
  const Eigen e = eigen(M);
  Tensor result = L_c;
  for (std::size_t i = 0; i < 3; ++i)
    if (e.value[i] > flat * e.value[2])
      result += outer((1 / e.value[i]) * dot(rest, e.vector[i]), e.vector[i]);
  return result;
}

/// For `one_sided_gradient`: no boundary face counts.
inline const Vec3* nowhere(Index /*f*/) { return nullptr; }

}  // namespace fsi::solid
