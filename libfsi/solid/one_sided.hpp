#pragma once
// The velocity gradient on the solid's side of its surface.

#include "libfsi/field/field.hpp"
#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::solid {

/// L at owned cell c from the solid alone:
///   min over L of sum_n w |u_n - u_c - (L + L_n) / 2 . d|^2,  w = 1 / |d|^2,
/// over the vertex neighbours n with known(n), L in place of L_n where that is not inner(n). This
/// is the rule of the middle, exact for a quadratic u on the way to an inner neighbour. The sum
/// goes, with L, over the boundary faces f that have a velocity *u_at(f) too, and over the images
/// of c and its neighbours beyond planes of symmetry. In directions in which these do not spread,
/// L_c stays as it is given. L, u: owned and halo; u[c] a velocity.
template <class Velocity, class Known, class Inner, class BoundaryVelocity>
Tensor one_sided_gradient(const CellField<Tensor>& L, const Velocity& u, const Known& known,
                          const Inner& inner, const BoundaryVelocity& u_at, const Mesh& mesh,
                          Index c, const SymmetryFaces& symmetry = {}) {
  SlopeFit fit(L[c]);
  for_vertex_neighbours(c, mesh, [&](Index n, const Vec3& d) {
    if (!known(n)) return;
    const Vec3 du = u[n] - u[c];
    inner(n) ? fit.add_pair(d, du, L[n]) : fit.add(d, du);
  });
  for_images(c, symmetry, mesh, [&](Index k, const Vec3& d, const Vec3& n) {
    if (!known(k)) return;
    const Vec3 du = image(u[k], n) - u[c];
    inner(k) ? fit.add_pair(d, du, image(L[k], n)) : fit.add(d, du);
  });
  for (const Index f : mesh.cell_faces[c])
    if (const Vec3* u_f = f < mesh.n_internal ? nullptr : u_at(f)) fit.add(mesh.d[f], *u_f - u[c]);
  constexpr Real flat = 0.05;  // part of the largest spread that counts as none
  return fit.slope(flat);
}

/// For `one_sided_gradient`: no boundary face counts.
inline const Vec3* nowhere(Index /*f*/) { return nullptr; }

}  // namespace fsi::solid
