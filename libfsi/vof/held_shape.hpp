#pragma once
// The rule that holds alpha to the shape that the map gives.

#include <span>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/geometry/cut.hpp"
#include "libfsi/shapes/shapes.hpp"

namespace fsi::vof {

/// In the cells near bonded faces of walls the plane n . x = s of the nearest one; elsewhere n = 0.
struct BondPlanes {
  /// Collective. bonded: boundary faces; rings: of vertex neighbours around their cells.
  BondPlanes(const Mesh& mesh, std::span<const Index> bonded, int rings);

  CellField<Vec3> n;  ///< unit normal, out of the mesh
  CellField<Real> s;  ///< n . x in the plane
};

/// The map of the memory or of the map kinematics, xi = x + xihat, and the undeformed solid.
struct ShapeMap {
  const shapes::Shape& shape;         ///< the undeformed solid, its signed distance
  const CellField<Vec3>& d;           ///< xihat = xi - x
  const CellField<Tensor>& gradient;  ///< of xihat
  std::span<const Index> cells;       ///< owned, where xihat is set
  std::span<const Real> weight;       ///< [cells] the trust vartheta in the map, 0 to 1
  std::span<const Index> strays{};   ///< owned, with solid that came off; in `cells` with no weight
  const BondPlanes* bond = nullptr;  ///< of the walls to which the solid is bonded
};

/// What `hold_shape` did.
struct Held {
  Real moved = 0;     ///< volume that moved, in parts of the solid's
  Real returned = 0;  ///< volume that came back from the strays
};

/// Scratch of `hold_shape`; grows with the interface.
struct HoldScratch {
  /// mesh must outlive it.
  explicit HoldScratch(const Mesh& mesh) : cell(mesh.dim) {}

  std::vector<Index> cells;             ///< near the surface that the map gives
  std::vector<geometry::Plane> planes;  ///< of that surface, about the cell's centre
  std::vector<Real> weight, change;     ///< [cells]
  geometry::Polytope cell;              ///< scratch
  Vec3 laps;                            ///< periods that the solid has crossed
};

/// Collective. Finds where the map tells of solid that is not there, as where an opening has cut
/// the solid and the flow turned back. Such cells, and all their vertex neighbours, have less than
/// half of solid, and their centres lie in the shape that the map gives. At first such a cell is
/// still outside. So cells at openings count, too. Sets `near` to 1 in all of these and in `rings`
/// rings of vertex neighbours around them, to 0 elsewhere; owned and halo. map.weight is not used.
void mark_cut(CellField<Real>& near, const CellField<Real>& alpha, const ShapeMap& map,
              const Mesh& mesh, int rings, std::span<const Index> at_openings);

/// Collective. Moves the fractions towards those of the solid that the map gives, {x : shape(xi(x))
/// < shift}. The surface of that solid is a material one. The advection of alpha uses the mean
/// velocity of faces, and its surface departs from the material one with time. In a cell near it
/// the surface is the plane
///
///   l + m . (x - x_c) = shift,   l = (shape(xi_c) + k_s h^2 / 24) / |g|,   m = g / |g|,
///   g = (grad xi)^T . grad shape(xi_c),   grad xi = I + grad xihat.
///
/// k_s = div grad shape is the sum of the curvatures, and k_s h^2 / 24 is what they add to the mean
/// of shape over the cell. A surface at a bonded wall has no fluid beyond it, so the cells whose
/// nearest point of shape(X) = 0 lies in a plane of map.bond stay as they are. In a call alpha
/// changes by at most 0.05 times the weight. The one number shift keeps the sum of alpha V to
/// rounding. If no shift does so to 1e-5 of it, nothing is changed. alpha: owned and halo, before
/// and after. Returns zeros if nothing was changed.
///
/// A solid does not tear. What advection leaves behind as a stray is outside of the shape, so its
/// cells empty by 0.05 in a call, and `shift` brings the volume back to the surface of the solid.
Held hold_shape(CellField<Real>& alpha, const ShapeMap& map, const Mesh& mesh,
                HoldScratch& scratch);

}  // namespace fsi::vof
