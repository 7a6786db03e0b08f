#pragma once
// Areas, volumes and centroids from corners. One order of operations: the same corners give the
// same bits on every rank.

#include <span>

#include "libfsi/core/types.hpp"
#include "libfsi/mesh/cells.hpp"

namespace fsi {

/// A face.
struct FaceMetrics {
  Vec3 Sf;      ///< area vector, right-handed about the order of the corners
  Vec3 centre;  ///< centroid
};
/// A cell.
struct CellMetrics {
  Real V = 0;   ///< volume, negative for a cell turned inside out; area in 2-D
  Vec3 centre;  ///< centroid
};

/// A polygon, flat or not, as the fan of triangles about the mean of its corners: the sum of Sf
/// over a closed cell vanishes to round-off. Two corners: an edge of a 2-D cell, Sf to its right.
FaceMetrics face_metrics(std::span<const Vec3> corners);

/// A cell bounded by such fans, as tets from the mean of its corners (2-D: triangles).
CellMetrics cell_metrics(CellType type, std::span<const Vec3> corners);

}  // namespace fsi
