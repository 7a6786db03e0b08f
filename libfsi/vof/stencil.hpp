#pragma once
// The least-squares gradient over the cells that share a vertex.

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::vof {

/// Inverse of M = sum w d (x) d over the vertex neighbours of owned cell c, d from cell to
/// neighbour, w = 1 / |d|^2; on directions in which the neighbours do not spread (a corner cell, a
/// layer one cell thick) the pseudo-inverse, so that the gradient there is zero.
SymTensor least_squares(const Mesh& mesh, Index c);

/// grad q = M^-1 sum w d (q_k - q_c), exact for linear q. fit: of `least_squares`. q: the
/// neighbours' values set.
Vec3 gradient_at(const CellField<Real>& q, const SymTensor& fit, const Mesh& mesh, Index c);
/// L_ij = d u_i / d x_j.
Tensor gradient_at(const CellField<Vec3>& u, const SymTensor& fit, const Mesh& mesh, Index c);

}  // namespace fsi::vof
