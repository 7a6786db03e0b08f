#pragma once
// The one-sided velocity gradient, from the solid's side of its surface.

#include "libfsi/field/field.hpp"
#include "libfsi/operators/least_squares.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::solid {

/// L at owned cell c, fitted to the known vertex neighbours k alone by the trapezoidal rule:
///   min over L of sum_k w_k |u_k - u_c - (L + L_k) / 2 . r_k|^2,   w_k = 1 / |r_k|^2.
/// L stands in place of L_k if k is not inner(k). The rule is exact for a quadratic u on the line
/// to an inner cell. The images of c and its neighbours beyond planes of symmetry count too, and so
/// does each boundary face f with a velocity *u_at(f), with L . d. In directions that the r_k do
/// not span, L_c stays as given. L, u: owned and halo; u[c] a velocity.
template <class Velocity, class Known, class Inner, class BoundaryVelocity>
Tensor one_sided_gradient(const CellField<Tensor>& L, const Velocity& u, const Known& known,
                          const Inner& inner, const BoundaryVelocity& u_at, const Mesh& mesh,
                          Index c, const SymmetryFaces& symmetry = {}) {
  SlopeFit fit(L[c]);
  for_neighbours_and_images(c, symmetry, mesh, [&](Index k, const Vec3& d, const Reflection& n) {
    if (!known(k)) return;
    const Vec3 du = image(u[k], n) - u[c];
    inner(k) ? fit.add_pair(d, du, image(L[k], n)) : fit.add(d, du);
  });
  for (const Index f : mesh.cell_faces[c])
    if (const Vec3* u_f = f < mesh.n_internal ? nullptr : u_at(f)) fit.add(mesh.d[f], *u_f - u[c]);
  constexpr Real flat =
      0.05;  // part of the largest eigenvalue below which a direction is not spanned
  return fit.slope(flat);
}

/// For `one_sided_gradient`: no boundary face has a velocity.
inline const Vec3* nowhere(Index /*f*/) { return nullptr; }

}  // namespace fsi::solid
