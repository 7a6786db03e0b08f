#pragma once
// What alternates from cell to cell of triangles and tetrahedra, taken out of psi and of the map.

#include <algorithm>
#include <cmath>

#include "libfsi/field/field.hpp"
#include "libfsi/operators/stencil.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::solid {

/// The part of what alternates from cell to cell that psi and the map lose in a time dt,
///   1 - exp(-C r dt),   r = min(speed / h, recovery),   C = 0.1.
/// speed, recovery: of a wave as long as a cell, where viscosity does not matter and where it
/// rules. Half of C leaves G* = 10 rough on triangles, five times C costs the disc's error a tenth.
inline Real alternating_part(Real speed, Real recovery, Real h, Real dt) {
  constexpr Real C = 0.1;
  return 1 - std::exp(-C * std::min(speed / h, recovery) * dt);
}

/// Fourth differences at owned cell c [Jameson81],
///   sum w (T_k - T - (g + g_k) / 2 . r_k) / sum w,   w = 1 / |r_k|^2,
/// over the vertex neighbours k with known(k) and their images beyond planes of symmetry. Nothing
/// of a linear T, and nothing where there is no such neighbour. rise(k, r): g_k . r, also at c. T:
/// owned and halo.
template <class Value, class Known, class Rise>
Value alternation(const CellField<Value>& T, const Known& known, const Rise& rise, const Mesh& mesh,
                  const SymmetryFaces& symmetry, Index c) {
  Value sum{};
  Real weights = 0;
  const auto add = [&](const Value& T_k, const Value& rise_k, const Vec3& r) {
    const Real w = 1 / norm2(r);
    sum += w * (T_k - T[c] - 0.5 * (rise(c, r) + rise_k));
    weights += w;
  };
  for_vertex_neighbours(c, mesh, [&](Index k, const Vec3& r) {
    if (known(k)) add(T[k], rise(k, r), r);
  });
  for_images(c, symmetry, mesh, [&](Index k, const Vec3& r, const Vec3& n) {
    if (known(k)) add(image(T[k], n), image(rise(k, image(r, n)), n), r);
  });
  return weights > 0 ? (1 / weights) * sum : Value{};
}

}  // namespace fsi::solid
