#pragma once
// Triangles and tetrahedra cut by the zero set of a function given at their corners.

#include <array>

#include "libfsi/core/types.hpp"

namespace fsi::geometry {

/// Its corners.
using Triangle = std::array<Vec3, 3>;
/// Its corners.
using Tetrahedron = std::array<Vec3, 4>;

/// Corner pairs of the edges, in the order of every array of edge values below.
inline constexpr std::array<std::array<std::size_t, 2>, 3> triangle_edges{{{0, 1}, {0, 2}, {1, 2}}};
/// The same of a tetrahedron.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tetrahedron_edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Size of the simplex, positive for both orientations: area, volume.
inline Real measure(const Triangle& x) { return norm(cross(x[1] - x[0], x[2] - x[0])) / 2; }
/// The same of a tetrahedron.
inline Real measure(const Tetrahedron& x) {
  return std::abs(dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0]))) / 6;
}

/// A point of the zero set on the edge between two corners: (1 - s) x[from] + s x[to].
struct Crossing {
  /// Numbers of the corners.
  std::size_t from = 0, to = 0;
  Real s = 0;  ///< place between them, 0 to 1
};

/// Zero set of a linear function in a simplex: n corners in order around it, n = 0 where there is
/// none. Triangle: n = 2; tetrahedron: n = 3 or 4.
struct Section {
  int n = 0;                     ///< count of corners
  std::array<Crossing, 4> at{};  ///< the corners
};

/// The zero set of the linear function with these corner values; a corner value of zero counts as
/// positive.
Section section(const std::array<Real, 3>& value);
/// The same in a tetrahedron.
Section section(const std::array<Real, 4>& value);

/// Exact part of the simplex, in [0, 1], where the linear function with these corner values is
/// negative. Free of cancellation: the result is a sum of positive terms.
Real negative_fraction(const std::array<Real, 3>& value);
/// The same in a tetrahedron.
Real negative_fraction(const std::array<Real, 4>& value);

/// Area or volume, in [0, measure(x)], where the quadratic function with these values at the
/// corners and at the edge middles is negative. It is of first order in the departure q from the
/// linear function:
///   V = V_linear - integral over the linear zero set of q / |grad phi| dA.
/// For the distance to a smooth surface the error falls with the fifth power of the size (area:
/// fourth) or faster. Exact where the function is linear. No correction where the corners are of
/// one sign.
Real negative_measure(const Triangle& x, const std::array<Real, 3>& corner,
                      const std::array<Real, 3>& middle);
/// The same in a tetrahedron.
Real negative_measure(const Tetrahedron& x, const std::array<Real, 4>& corner,
                      const std::array<Real, 6>& middle);

}  // namespace fsi::geometry
