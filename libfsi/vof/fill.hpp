#pragma once
// The volume fractions of a shape: the initial state of the interface.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/shapes/shapes.hpp"
#include "libfsi/vof/symmetry.hpp"

namespace fsi::vof {

/// The accuracy of the division of cells that the surface cuts.
struct FillAccuracy {
  /// A simplex of the cell is divided until one more division changes its part of the solid by no
  /// more than this, in units of the cell's volume.
  Real tolerance = 1e-5;
  /// The least number of divisions, so that two coarse estimates do not agree by chance, and the
  /// largest. An edge of the shape is resolved to the cell size / 2^max_depth.
  int min_depth = 1, max_depth = 8;
};

/// The result of filling, over all ranks.
struct Filled {
  Real volume = 0;  ///< sum alpha V (area in 2-D)
  /// Error of `volume` by the change in the last division: |sum over cells| + (sum of
  /// squares)^(1/2) of smooth parts, and the sum of sizes at sharp edges.
  Real estimated_error = 0;
  /// Least signed distance of the shape at corners and centres of boundary faces, without those of
  /// `mirrors`. It is the distance of the solid from the boundary. It is negative if the solid
  /// sticks out of the mesh, so that `volume` misses a part of it.
  Real clearance = 0;
  /// Largest |f(a) - f(b)| / |a - b| of the shape between the centres of cells beside each other,
  /// of those near the surface: above 1 the shape is no distance, and `volume` is wrong.
  Real steepest = 0;
  /// The planes of `mirrors` that cut the solid. The whole solid is its part in the mesh and the
  /// images of this part.
  CuttingPlanes cut_by{};
  /// Whether the centre of a cell lies in the solid and in its image across a period, in one deeper
  /// than in the other. An endless shape is its own image.
  bool overlaps_itself = false;
  /// Whether the solid touches its image across a period, as one that is exactly a period long.
  bool touches_itself = false;
};

/// Collective. alpha = part of each cell inside the shape (negative distance), in [0, 1], exactly 0
/// or 1 away from the surface. Cells are divided into simplices about their centre (and the face
/// centres in 3-D), these into 4 (8 in 3-D) wherever the surface may be; on the last ones the
/// distance is taken quadratic (geometry/simplex.hpp). Volume error: order 3.4 in the size of
/// the last simplices for a smooth shape (measured), second order along edges of a cylinder or box.
/// Torus, 32 cells per unit length, r = 0.1: 3e-8 of its volume. A shape that leaves the mesh
/// through a periodic face enters at the other: it is evaluated at all `translation` images. Needs
/// cells that are star-shaped about C. mirrors: patches that may cut the solid, planes of symmetry.
/// On return owned cells and halo are set.
Filled fill(CellField<Real>& alpha, const Mesh& mesh, const shapes::Shape& shape,
            const std::vector<Patch>& mirrors = {}, const FillAccuracy& accuracy = {});

}  // namespace fsi::vof
