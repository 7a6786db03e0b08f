#pragma once
// The surface where a reference map puts it.

#include <span>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/geometry/cut.hpp"
#include "libfsi/shapes/shapes.hpp"

namespace fsi::vof {

/// Where the particle of each cell was in the undeformed solid: xi = x + d.
struct ShapeMap {
  const shapes::Shape& shape;         ///< the undeformed solid, its signed distance
  const CellField<Vec3>& d;           ///< xi - x
  const CellField<Tensor>& gradient;  ///< of d
  std::span<const Index> cells;       ///< owned, where d is set
  std::span<const Real> weight;       ///< [cells] in [0, 1]: how far the map is to be relied on
};

/// Scratch of `hold_shape`; grows with the interface.
struct HoldScratch {
  /// mesh must outlive it.
  explicit HoldScratch(const Mesh& mesh) : cell(mesh.dim) {}

  std::vector<Index> cells;                ///< near the mapped surface
  std::vector<geometry::Plane> planes;     ///< of that surface, about the cell's centre
  std::vector<Real> weight, area, change;  ///< beside `cells`
  geometry::Polytope cell;                 ///< scratch
  Vec3 laps;                               ///< periods that the solid went through
};

/// Collective. Moves the fractions toward those of the solid whose surface is where the map puts
/// it, {x : shape(xi(x)) < shift}. That is a material surface. What carries alpha by the mean
/// velocity of faces loses it in the course of time. In a cell near it the surface is the plane
///
///   s + m . (x - x_c) = shift,   s = (shape(xi_c) + k h^2 / 24) / |g|,   m = g / |g|,
///   g = (I + grad d)^T . grad shape(xi_c)
///
/// k = div grad shape is the sum of the curvatures; k h^2 / 24 is what they add to the mean of
/// shape over the cell. The change of a cell is at most a twentieth of it in a call, times its
/// weight. shift makes the sum of alpha V what it was, to round-off; where none does to 1e-5 of it
/// nothing is changed. alpha: owned and halo, before and after. Returns the volume that changed
/// cells, in parts of the solid's; 0: nothing was held.
Real hold_shape(CellField<Real>& alpha, const ShapeMap& map, const Mesh& mesh,
                HoldScratch& scratch);

}  // namespace fsi::vof
