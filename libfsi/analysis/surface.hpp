#pragma once
// The surface of the solid as triangles (segments in 2-D): for pictures and shape measures.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/geometry/mirror.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::analysis {

/// This rank's part of a surface, facet by facet: facet k has the corners points[dim k] to
/// points[dim k + dim - 1]. Its normal points out of the solid (right-handed; in 2-D the solid lies
/// on the left of the segment).
struct Surface {
  int dim = 3;               ///< 2 or 3
  std::vector<Vec3> points;  ///< corners, `dim` to a facet

  /// Count of facets.
  Index size() const { return static_cast<Index>(points.size()) / dim; }
  /// The corners of facet k.
  const Vec3* facet(Index k) const { return points.data() + static_cast<std::ptrdiff_t>(dim) * k; }
  /// Area, or length in 2-D, of facet k.
  Real measure(Index k) const {
    const Vec3* x = facet(k);
    return dim == 2 ? norm(x[1] - x[0]) : norm(cross(x[1] - x[0], x[2] - x[0])) / 2;
  }
};

/// The surface alpha = 0.5 within owned cells. alpha is brought to the corners of the cells by
/// linear interpolation [Holmes89]. The cells are divided into simplices about the mean of their
/// corners, in 3-D about that of their faces too, and alpha is linear on each. So the parts fit
/// without gaps, across cells and ranks. A cell away from the surface costs one loop over its
/// neighbours. Every part is placed at its image nearest to `about` (a point in the solid), so a
/// solid on a periodic seam is in one piece. mirrors: the planes of symmetry that cut the solid; at
/// a corner on one, the images of the cells count too. The interpolation rounds the surface: an
/// error of second order, 0.1 cells inward at a radius of three cells. alpha: owned and halo.
Surface isosurface(const CellField<Real>& alpha, const Mesh& mesh, const Vec3& about,
                   const std::vector<geometry::Mirror>& mirrors = {});

/// The surface and its images in planes of symmetry, one after the other: that of the whole solid
/// where the mesh holds a part of it.
Surface with_images(Surface surface, const std::vector<geometry::Mirror>& mirrors);

/// Collective. Area (length) of the surface of all ranks.
Real area(const Surface& surface);

/// Collective. Volume (area) it encloses, by the divergence theorem; meaningful where it is closed.
Real enclosed(const Surface& surface);

}  // namespace fsi::analysis
