#pragma once
// A cell cut by a plane: volumes, the plane of a given fraction, the cut itself; a face swept by a
// moving plane. Pure functions.

#include <array>

#include "libfsi/core/types.hpp"

namespace fsi::geometry {

/// A flat face: corners in order, right-handed about its outward area vector. 2-D: the two ends.
struct Polygon {
  static constexpr int capacity = 10;
  std::array<Vec3, capacity> x;
  int n = 0;
};

/// A cell as its faces. Invariant: the faces are closed, flat and outward. 2-D: edges in the plane
/// z = 0 with `area` their outward normal times length; 3-D: `area` is unused.
struct Cell {
  static constexpr int capacity = 26;
  std::array<Polygon, capacity> face;
  std::array<Vec3, capacity> area;
  int n = 0;
  int dim = 3;
};

/// Appends a face; a 3-D face of more than three corners that is not flat is divided into triangles
/// about the mean of its corners.
void add_face(Cell& cell, const Polygon& face, const Vec3& outward);

/// Volume (2-D: area) of the part of the cell where n . x <= s; n is a unit vector.
/// By the divergence theorem about a point of the plane, so that the cut does not enter.
Real volume_below(const Cell& cell, const Vec3& n, Real s);

/// A plane n . x = s in a cell: its centroid and area (2-D: length) inside.
struct Cut {
  Real s = 0, area = 0;
  Vec3 centre;
};

/// The plane of unit normal n that leaves the fraction alpha in (0, 1) of the cell's volume V where
/// n . x <= s. |V(s) - alpha V| <= 1e-13 V.
Cut cut_at_fraction(const Cell& cell, const Vec3& n, Real alpha);

/// Part (0 to 1) of a face where n . x <= s.
Real part_below(const Polygon& face, const Vec3& n, Real s);

/// Mean over the time dt of the part of the face where n . x <= s + speed t: exact, by Simpson's
/// rule between the passages of the corners, where the part is a polynomial of at most second
/// degree.
Real mean_part_below(const Polygon& face, const Vec3& n, Real s, Real speed, Real dt);

}  // namespace fsi::geometry
