#pragma once
// Removes the divergence of the cell velocities from the velocity gradient that strains a solid.

#include "libfsi/field/field.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/inward_normal.hpp"

namespace fsi::solid {

/// phi_f - u_f . S_f of an internal face, with u_f the face value of the flux operator and the mean
/// of L over both cells. L: set on both sides of irregular faces.
inline Real flux_defect(const FlowSnapshot& snapshot, const Mesh& mesh, Index f) {
  const FaceWeights& weights = snapshot.weights;
  Vec3 u_f = mirror_mean(snapshot.u, f, weights, mesh);
  if (weights.place[f] >= 0)
    u_f += dot(face_mean(snapshot.L, f, weights, mesh), weights.from_mirror(f, mesh));
  return snapshot.phi[f] - dot(u_f, mesh.Sf[f]);
}

/// The velocity utilde of known cell c, corrected by the fluxes of faces between two known cells.
/// r_f leads from the centre along d to the face:
///   utilde_c = u_c + (1/V) sum_f (phi_f - u_f . S_f) r_f,   r_f from the centre along d to the
///   face.
/// The projection changes the fluxes by the compact gradient of the pressure's increment and u by
/// the averaged one; the sum is their difference. At the surface u has a kink, so faces there do
/// not count.
inline Vec3 velocity_of_fluxes(const FlowSnapshot& snapshot, const CellField<Real>& alpha,
                               const Mesh& mesh, Index c) {
  Vec3 sum;
  for (const Index f : mesh.cell_faces[c]) {
    if (f >= mesh.n_internal) continue;
    const Index P = mesh.owner[f], N = mesh.neighbour[f];
    if (!(alpha[P] >= alpha_known && alpha[N] >= alpha_known)) continue;
    const Real part = P == c ? snapshot.weights.lambda[f] : 1 - snapshot.weights.lambda[f];
    sum += (part * flux_defect(snapshot, mesh, f)) * mesh.d[f];
  }
  return snapshot.u[c] + (1 / mesh.V[c]) * sum;
}

/// Gradient at owned cell c with the normal velocity of its faces from the fluxes,
///   L + (1/V) sum_f (phi_f - u_f . S_f) n_f (x) n_f,   n_f = S_f / |S_f|,   outward sum.
/// It is exact for a linear u with the fluxes of that u. On an orthogonal mesh its trace is div
/// phi. L: set in the cell's neighbours too at irregular faces.
inline Tensor flux_consistent_gradient(const FlowSnapshot& snapshot, const Mesh& mesh, Index c) {
  Tensor sum;
  for (const Index f : mesh.cell_faces[c]) {
    if (f >= mesh.n_internal) continue;
    const Vec3& S = mesh.Sf[f];
    const Real rest = flux_defect(snapshot, mesh, f);
    sum += (outward(mesh, f, c) * rest / norm2(S)) * outer(S, S);
  }
  return snapshot.L[c] + (1 / mesh.V[c]) * sum;
}

/// L of a cell at the surface without its trace, which is taken off along the normal m of the
/// surface:
///   L - tr(L) m (x) m,   m from `inward_normal`.
/// Derivatives along the surface are continuous, and div u = 0 gives the normal one. It is L itself
/// if alpha is symmetric about the cell.
inline Tensor remove_normal_divergence(const Tensor& L, const CellField<Real>& alpha,
                                       const Mesh& mesh, Index c,
                                       const SymmetryFaces& symmetry = {}) {
  const Vec3 n = inward_normal(alpha, mesh, c, symmetry);
  return n == Vec3{} ? L : L + (-trace(L)) * outer(n, n);
}

}  // namespace fsi::solid
