#pragma once
// The solid's volume fraction carried by the flux, cut from the planes of the interface.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/vof/bend.hpp"
#include "libfsi/vof/reconstruct.hpp"

namespace fsi::vof {

/// What a step of advection met.
struct AdvectReport {
  Real courant = 0;    ///< largest (dt / 2V) sum |phi| of the cells at the interface
  int rounds = 0;      ///< of redistribution
  Real overshoot = 0;  ///< largest excess over [0, 1] before redistribution
  Real remaining = 0;  ///< and after it; above 1e-12 only where the Courant number exceeds one
  Real returned = 0;   ///< volume given back to the interface, |sum|: divergence of phi and wisps

  /// Of this part of a step and the next one.
  void add(const AdvectReport& next) {
    courant += next.courant;
    rounds = std::max(rounds, next.rounds);
    overshoot = std::max(overshoot, next.overshoot);
    remaining = std::max(remaining, next.remaining);
    returned += next.returned;
  }
};

/// Scratch of `advect`, made once. After a step it holds the solid's volume flux.
struct AdvectScratch {
  /// Collective. mesh must outlive it.
  explicit AdvectScratch(const Mesh& mesh);

  FaceField<Real> solid;     ///< volume of solid through each face in the last step, from P to N
  std::vector<Index> faces;  ///< where the flux is more than alpha phi dt with alpha 0 or 1
  std::vector<Index> full;   ///< other faces inside the solid
  std::vector<Index> cells;  ///< owned cells of `faces`
  std::vector<Index> rim;    ///< internal faces with a halo cell
  /// [n_faces], [n_cells] whether the item is in a list.
  std::vector<std::uint8_t> face_marked, cell_marked;
  CellField<Vec3> velocity;  ///< at the centre of the plane
  bool any_bends;            ///< whether a cell of any rank does
  CellField<Bend> bend;      ///< of the interface
  geometry::Polytope cell;   ///< scratch
  CellField<Real> share;     ///< of a cell's outflow changed by a round of redistribution
};

/// Collective. One step of isoAdvector [Roenby16]. Through every face near the interface goes the
/// volume that the upwind cell's plane sweeps, moving along its normal with the velocity at its
/// centre, for a time dt. In a tetrahedron it is the paraboloid about the plane that sweeps, moved
/// aside with this velocity for half of dt. Where cells would leave [0, 1] their outflow is raised
/// (lowered) until they do not: the excess goes along with the flow, and no volume is clipped. With
/// a divergence-free phi the sum of alpha V is kept to round-off. The amount that div phi != 0 and
/// fractions within 1e-12 of 0 or 1 would add is given back to the cells of the interface, each in
/// proportion to V alpha (1 - alpha). The sum stays, and full cells stay full.
/// Through boundary faces solid can leave; what enters there is fluid.
/// alpha, u: owned and halo set; interface: of this alpha. Courant number (dt / 2V) sum |phi| <= 1.
/// On return owned cells and halo of alpha are set.
AdvectReport advect(CellField<Real>& alpha, const Interface& interface, const FaceField<Real>& phi,
                    const CellField<Vec3>& u, Real dt, const Mesh& mesh, AdvectScratch& scratch);

}  // namespace fsi::vof
