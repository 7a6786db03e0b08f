#pragma once
// The velocity gradient on the solid's side of its surface.

#include "libfsi/field/field.hpp"

namespace fsi::solid {

/// L at owned cell c from the solid alone:
///   min over L of sum_n w |u_n - u_c - L . d|^2,  w = 1 / |d|^2,
/// over the vertex neighbours with alpha >= alpha_min. Exact for linear u; of first order where all
/// of them lie on one side. Where they do not span space, L_c, the gradient over all neighbours, in
/// the directions that they leave out. u, alpha: owned and halo.
Tensor one_sided_gradient(const Tensor& L_c, const CellField<Vec3>& u, const CellField<Real>& alpha,
                          Real alpha_min, const Mesh& mesh, Index c);

}  // namespace fsi::solid
