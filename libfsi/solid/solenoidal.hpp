#pragma once
// The divergence that cell velocities keep, taken out of the velocity gradient that strains a
// solid.

#include "libfsi/field/field.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/inward_normal.hpp"

namespace fsi::solid {

/// phi_f - u_f . S_f of an inner face, u_f as in the flux itself, with the cells' mean L.
/// L: set on both sides of irregular faces.
inline Real flux_defect(const FlowSnapshot& snapshot, const Mesh& mesh, Index f) {
  const FaceWeights& weights = snapshot.weights;
  Vec3 u_f = mirror_mean(snapshot.u, f, weights, mesh);
  if (weights.place[f] >= 0)
    u_f += dot(face_mean(snapshot.L, f, weights, mesh), weights.from_mirror(f, mesh));
  return snapshot.phi[f] - dot(u_f, mesh.Sf[f]);
}

/// Velocity of known cell c with what the fluxes between known cells tell besides,
///   u + (1/V) sum_f (phi_f - u_f . S_f) r_f,   r_f from the centre along d to the face:
/// the part of a pressure's increment that its averaged gradient leaves in u but the flux does not
/// have. No face at the surface takes part, where u has a kink.
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

/// Gradient at owned cell c with the flux for the normal velocity of its faces,
///   L + (1/V) sum_f (phi_f - u_f . S_f) n (x) n,   n = S_f / |S_f|,
/// the sum outward: exact for linear fields whose flux is theirs, its trace on an orthogonal mesh
/// div phi. L: that of the cell's neighbours too at irregular faces.
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

/// L of a cell at the surface with its trace taken out along the normal,
///   L - tr(L) n (x) n,   n that of `inward_normal`:
/// what differs along the surface is continuous and smooth, div u = 0 gives the rest. L itself
/// where the solid is alike on all sides.
inline Tensor remove_normal_divergence(const Tensor& L, const CellField<Real>& alpha,
                                       const Mesh& mesh, Index c) {
  const Vec3 n = inward_normal(alpha, mesh, c);
  return n == Vec3{} ? L : L + (-trace(L)) * outer(n, n);
}

}  // namespace fsi::solid
