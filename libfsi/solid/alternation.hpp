#pragma once
// Removes from psi and from the memory what alternates from cell to cell of the simplex zone.

#include <algorithm>
#include <cmath>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/face_weights.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::solid {

/// How fast the memory draws psi in the simplex zone, in units of c_s / h. On tetrahedra its fits
/// take some sixty neighbours, on triangles twelve, and waves grow faster on tetrahedra.
constexpr Real recall_in_zone(Index dim) { return dim == 3 ? 0.1 : 0.02; }

/// The part gamma of the fourth differences that psi and the memory lose in a time dt,
///   gamma = 1 - exp(-max(C omega, q c_s / h) dt),   omega = min(c_s / h, G / mu_s),   C = 0.1.
/// least: q, 0 for psi. The memory loses what alternates as fast as psi is drawn to it. Else psi
/// takes an alternation of the memory over, its stress moves the solid by the rate G / mu_s, and in
/// viscous layers at a wall the memory feeds itself.
/// speed: c_s, the rate without viscosity times h. recovery: G / mu_s, the rate where viscosity
/// dominates. Half of C leaves a solid of G* = 10 rough on triangles. Five times C raises the error
/// of the disc by a tenth.
inline Real alternating_part(Real speed, Real recovery, Real h, Real dt, Real least = 0) {
  constexpr Real C = 0.1;
  return 1 - std::exp(-std::max(C * std::min(speed / h, recovery), least * speed / h) * dt);
}

/// Collective. The part of gamma that the map loses in each owned cell, `in_zone` in the simplex
/// zone. Elsewhere it is twice the largest tangent of the angle between d and S, at most 1, and 0
/// where they differ by rounding.
std::vector<Real> lost_part(const FaceWeights& weights, const Mesh& mesh, Real in_zone);

/// Fourth differences at owned cell c [Jameson81],
///   sum_k w_k (T_k - T - (Gamma + Gamma_k) / 2 . r_k) / sum_k w_k,   w_k = 1 / |r_k|^2,
/// over the vertex neighbours k with known(k) and their images beyond planes of symmetry. It is
/// zero for a linear T, and zero without such neighbours. rise(k, r): Gamma_k . r, also at c. T:
/// owned and halo.
template <class Value, class Known, class Rise>
Value alternation(const CellField<Value>& T, const Known& known, const Rise& rise, const Mesh& mesh,
                  const SymmetryFaces& symmetry, Index c) {
  Value sum{};
  Real weights = 0;
  for_neighbours_and_images(c, symmetry, mesh, [&](Index k, const Vec3& r, const Reflection& n) {
    if (!known(k)) return;
    const Real w = 1 / norm2(r);
    const Value rise_k = image(rise(k, image(r, n)), n);
    sum += w * (image(T[k], n) - T[c] - 0.5 * (rise(c, r) + rise_k));
    weights += w;
  });
  return weights > 0 ? (1 / weights) * sum : Value{};
}

}  // namespace fsi::solid
