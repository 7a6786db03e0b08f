#pragma once
// Advection of the volume fraction by the flux, with the planes of the interface.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/vof/bend.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// Figures of a step of advection.
struct AdvectReport {
  Real courant = 0;  ///< largest (dt / 2V) sum |phi| of the cells at the interface
  /// Largest excess over [0, 1] that is left; above 1e-12 only where the Courant number exceeds
  /// one.
  Real remaining = 0;
  Real returned = 0;  ///< volume given back to the interface, |sum|: from div phi and from rounding

  /// Adds the figures of the next part of the step.
  void add(const AdvectReport& next) {
    courant += next.courant;
    remaining = std::max(remaining, next.remaining);
    returned += next.returned;
  }
};

/// Scratch of `advect`, made once. After a step it holds the solid's volume flux.
struct AdvectScratch {
  /// Collective. planes: of symmetry, beyond which the flow has an image. mesh must outlive it.
  explicit AdvectScratch(const Mesh& mesh, SymmetryFaces planes = {});

  SymmetryFaces symmetry;    ///< these planes
  FaceField<Real> solid;     ///< volume of solid through each face in the last step, from P to N
  std::vector<Index> faces;  ///< faces whose flux is not alpha phi dt with alpha 0 or 1
  std::vector<Index> full;   ///< other faces inside the solid
  std::vector<Index> cells;  ///< owned cells of `faces`
  std::vector<Index> rim;    ///< internal faces with a halo cell
  /// [n_faces], [n_cells] whether the item is in a list.
  std::vector<std::uint8_t> face_marked, cell_marked;
  CellField<Vec3> velocity;  ///< at the centre of the plane
  bool any_bends;            ///< whether a cell of any rank has a bend
  CellField<Bend> bend;      ///< of the interface
  geometry::Polytope cell;   ///< scratch
  CellField<Real> share;     ///< of a cell's outflow changed by a round of redistribution
};

/// Collective. One step of isoAdvector [Roenby16]. Through each face near the interface goes the
/// volume that the plane of the upwind cell sweeps in dt, moving along its normal with the velocity
/// at its centre. In a tetrahedron it is the volume that the paraboloid about the plane sweeps,
/// moved aside by this velocity times dt / 2. If a cell would leave [0, 1], its outflow is raised
/// or lowered until it does not: the excess goes on with the flow, and nothing is clipped. With a
/// divergence-free phi the sum of alpha V is kept to rounding. A remaining div phi, and fractions
/// within 1e-12 of 0 or 1, would change that sum. What they add is given back to the cells of the
/// interface in proportion to V alpha (1 - alpha). So the sum stays, and full cells stay full.
/// Solid may leave through boundary faces, and what enters there is fluid. alpha, u: owned and halo
/// set; interface: of this alpha. Courant number (dt / 2V) sum |phi| <= 1. On return owned cells
/// and halo of alpha are set.
AdvectReport advect(CellField<Real>& alpha, const Interface& interface, const FaceField<Real>& phi,
                    const CellField<Vec3>& u, Real dt, const Mesh& mesh, AdvectScratch& scratch);

}  // namespace fsi::vof
