#pragma once
// The neighbours of a cell and the two sides of a face.

#include <cmath>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"

namespace fsi {

/// Calls f(k, t) for the vertex neighbours k of owned cell c. t is the translation that brings k
/// next to c across a period.
template <class Function>
void for_vertex_images(Index c, const Mesh& mesh, Function&& f) {
  const Csr& around = mesh.cell_neighbours;
  for (Index i = around.offset[c]; i < around.offset[c + 1]; ++i)
    f(around.index[i], mesh.translation[mesh.cell_neighbour_shift[i]]);
}

/// Calls f(k, r) for the same cells, r from the centre of c to that of k, across a period if need
/// be.
template <class Function>
void for_vertex_neighbours(Index c, const Mesh& mesh, Function&& f) {
  for_vertex_images(c, mesh, [&](Index k, const Vec3& t) { f(k, mesh.C[k] - mesh.C[c] + t); });
}

/// The cell beyond face f from cell c; -1: the boundary.
inline Index beyond(const Mesh& mesh, Index f, Index c) {
  if (f >= mesh.n_internal) return -1;
  return mesh.owner[f] == c ? mesh.neighbour[f] : mesh.owner[f];
}

/// +1 where the normal of face f leaves cell c, -1 where it enters.
inline Real outward(const Mesh& mesh, Index f, Index c) { return mesh.owner[f] == c ? 1 : -1; }

/// (1 - lambda) q_P + lambda q_N of internal face f, of a field or of any q[cell].
template <class Values>
auto face_mean(const Values& q, Index f, const FaceWeights& weights, const Mesh& mesh) {
  const Real lambda = weights.lambda[f];
  return (1 - lambda) * q[mesh.owner[f]] + lambda * q[mesh.neighbour[f]];
}

/// lambda q_P + (1 - lambda) q_N of internal face f, the mirrored mean of the flux operator
/// (flow/projection.hpp).
template <class Values>
auto mirror_mean(const Values& q, Index f, const FaceWeights& weights, const Mesh& mesh) {
  const Real lambda = weights.lambda[f];
  return lambda * q[mesh.owner[f]] + (1 - lambda) * q[mesh.neighbour[f]];
}

/// h = V^(1/dim), the size of a cell.
inline Real cell_size(const Mesh& mesh, Index c) {
  return mesh.dim == 2 ? std::sqrt(mesh.V[c]) : std::cbrt(mesh.V[c]);
}

/// sum_f phi_f of a cell, outward.
inline Real net_outflow(const FaceField<Real>& phi, const Mesh& mesh, Index c) {
  Real sum = 0;
  for (const Index f : mesh.cell_faces[c]) sum += mesh.owner[f] == c ? phi[f] : -phi[f];
  return sum;
}

/// (1 / 2V) sum_f |phi_f| of a cell, its Courant number over the time step.
inline Real courant_rate(const FaceField<Real>& phi, const Mesh& mesh, Index c) {
  Real sum = 0;
  for (const Index f : mesh.cell_faces[c]) sum += std::abs(phi[f]);
  return sum / (2 * mesh.V[c]);
}

}  // namespace fsi
