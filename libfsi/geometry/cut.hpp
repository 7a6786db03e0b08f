#pragma once
// Parts of segments and triangles below a level, and a polygon or polyhedron cut by a plane.

#include <algorithm>
#include <array>
#include <span>

#include "libfsi/core/types.hpp"

namespace fsi::geometry {

/// Corner values of a segment (2) or triangle (3) in ascending order: a linear function on it.
template <std::size_t n>
using Levels = std::array<Real, n>;

/// Part of the segment or triangle, in [0, 1], where the function is below s. No cancellation.
inline Real part_below(const Levels<2>& q, Real s) {
  return s <= q[0] ? 0 : s >= q[1] ? 1 : (s - q[0]) / (q[1] - q[0]);
}
/// The same on a triangle.
inline Real part_below(const Levels<3>& q, Real s) {
  // s < q1: (s - q0)^2 / ((q1 - q0) (q2 - q0)); beyond: 1 - (q2 - s)^2 / ((q2 - q0) (q2 - q1))
  if (s <= q[0]) return 0;
  if (s >= q[2]) return 1;
  if (s <= q[1]) return (s - q[0]) / (q[1] - q[0]) * ((s - q[0]) / (q[2] - q[0]));
  return 1 - (q[2] - s) / (q[2] - q[0]) * ((q[2] - s) / (q[2] - q[1]));
}

/// Mean of part_below over the levels between s0 and s1 (any order; the value at s0 where they are
/// equal). It is the share of a time step for which a face lies behind a plane that moves evenly.
/// Exact, piece by piece between the passing of corners, without cancellation.
Real mean_part_below(const Levels<2>& q, Real s0, Real s1);
/// The same on a triangle.
Real mean_part_below(const Levels<3>& q, Real s0, Real s1);

/// The plane n . x = s, n of unit length; below it n . x < s.
struct Plane {
  Vec3 n;      ///< unit normal
  Real s = 0;  ///< its distance from the origin along n
};

/// Where a plane cuts a cell: area (length in 2-D), centroid and extent.
struct Cut {
  Real area = 0;     ///< length in 2-D
  Vec3 centre;       ///< its centroid
  SymTensor spread;  ///< mean of r r over it, r from the centroid
};

/// A polygon (2-D, in the plane z = 0) or polyhedron, given by its boundary: segments or triangles
/// that face outward. Faces with more than three corners are divided about the mean of their
/// corners, so warped ones fit their neighbours'. Invariant: at most max_points corners and
/// max_facets facets; larger cells are refused by an Error{internal}. Coordinates should be small:
/// relative to the cell.
class Polytope {
 public:
  /// Room.
  static constexpr int max_points = 96, max_facets = 96;

  /// Empty.
  explicit Polytope(int dim = 3) : dim_(dim) {}
  /// Empties it.
  void clear() { n_points_ = n_facets_ = 0; }
  /// A face with its corners right-handed about the outward normal (2-D: ends of an edge, the cell
  /// on its left); reversed: about the inward one.
  void add_face(std::span<const Vec3> corners, bool reversed);

  /// 2 or 3.
  int dim() const { return dim_; }
  /// Its corners.
  std::span<const Vec3> points() const { return {points_.data(), std::size_t(n_points_)}; }
  using Facet = std::array<std::uint8_t, 3>;  ///< corner numbers; the first two in 2-D
  /// Its facets.
  std::span<const Facet> facets() const { return {facets_.data(), std::size_t(n_facets_)}; }

 private:
  int dim_, n_points_ = 0, n_facets_ = 0;
  std::array<Vec3, max_points> points_;
  std::array<Facet, max_facets> facets_;
};

/// Area or volume.
Real measure(const Polytope& cell);

/// What lies below a plane, and how it changes with the plane's s.
struct Below {
  Real measure = 0;  ///< area in 2-D, volume in 3-D
  Real area = 0;     ///< of the cut: the derivative of measure by s
};

/// The part of a cell below the plane; its error is a few units of round-off of the cell's.
Below below(const Polytope& cell, const Plane& plane);

/// Its area or volume alone.
Real measure_below(const Polytope& cell, const Plane& plane);

/// The plane of normal n (unit) with the part `fraction` in (0, 1) of the cell below it, to a few
/// units of round-off. Both sides are equivalent: n, fraction and -n, 1 - fraction give the same
/// plane.
Plane plane_at(const Polytope& cell, const Vec3& n, Real fraction);

/// The cut through the cell; its area is zero where the plane misses it.
Cut cut(const Polytope& cell, const Plane& plane);

}  // namespace fsi::geometry
