#pragma once
// The velocity gradient on triangles and tetrahedra with a solid: of second order, of one side.

#include <span>
#include <utility>
#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/simplex_zone.hpp"

namespace fsi::solid {

/// Where the surface cuts cells, and what a kink j max(0, s) of u there, s the distance along n,
/// adds to their velocity. All owned and halo.
struct Cuts {
  const CellField<Real>& alpha;       ///< fraction of the solid
  const CellField<Vec3>& normal;      ///< n, out of the solid; zero in cells that are not cut
  const CellField<Real>& solid_side;  ///< phi: to that of the solid's side, u = u_S + j phi
  const CellField<Real>& fluid_side;  ///< phi - s: to that of the fluid's, u = u_F + j (phi - s)
};

/// What the velocity is at the faces of the boundary. Where neither holds, at an opening, it goes
/// on as inside: the boundary's value there is made of the cell's own and tells no gradient.
struct BoundarySides {
  std::vector<char>
      given{};  ///< [n_boundary] 1 where a wall or an inlet gives it; empty: everywhere
  SymmetryFaces symmetry{};  ///< beyond these lie the images of the cells
};

/// Sets L in the listed cells of the zone: those of the solid (alpha >= 1/2) that know their
/// strain, and all that share a vertex with one.
///
/// A triangle is not symmetric about its centre: the library's gradient is off by a part of
/// h grad grad u that changes sign from cell to cell, and the strain keeps it. At the surface,
/// where u has a kink, a gradient over both sides is off by a part of the jump besides, which the
/// non-orthogonal part of the viscous flux passes on to the velocity.
///
/// Here L is that of a quadratic (QuadraticFit) through the values of the vertex neighbours on the
/// cell's own side of alpha = 1/2. Their images beyond a plane of symmetry and the cell's faces on
/// walls take part. Cells of the solid beside its
/// surface take the gradients of those farther in as well. That does not tell L where the solid, or
/// what is around it, is thinner than the stencil. There L stays the library's, which answers to
/// the stress as that acts on the velocity. One of the few values of one side alone does not, and
/// with it a wisp in a corner of a cavity can tear the flow apart.
///
/// The velocity of a cut cell is neither side's. The fit of the solid's takes u - j phi, that of
/// the fluid's u - j (phi - s) (Cuts), with
///   j = (I - n n) . (L_out - L_in) . n,
/// The normal part is left out, as div u = 0 leaves none there. j is from a first fit without it:
/// L_in and L_out are the means over the vertex neighbours on either side, with weights alpha and
/// 1 - alpha.
class InterfaceGradient {
 public:
  /// mesh and zone must outlive it.
  InterfaceGradient(const Mesh& mesh, const SimplexZone& zone, BoundarySides sides = {});

  /// Collective. cells: owned, as above. L on entry: the library's gradient; L, u: owned and halo.
  void apply(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
             const Cuts& cuts, std::span<const Index> cells);

  /// Collective, after `apply` with the same L, u, u_b, alpha and cells, all of the solid's among
  /// them. Sets `strain` in the solid's cells. It is L in those whose vertex neighbours are all of
  /// the solid and tell the fit, and in those `near_wall`. In the others it
  /// is, by the pairs of cells of the solid,
  ///   min over L_c of sum_k w |u_k - u_c - (L_c + L_k) / 2 . d|^2,  w = 1 / |d|^2,
  /// and by u_b as where L changes no more (`one_sided_gradient`). All are found at once in a few
  /// sweeps, of which the first takes L_c for L_k where k is such a cell too. This is exact for
  /// linear u. What one sweep leaves of a quadratic, the next ones take down. A quadratic fit from
  /// one side answers to the errors of few values. Where L alternates from cell to cell each sweep
  /// adds to it. In a solid that is wedged between walls the strain then takes up more than the
  /// force gives, and grows at a third of G / mu.
  void set_strain(const CellField<Tensor>& L, const CellField<Vec3>& u,
                  const BoundaryField<Vec3>& u_b, const CellField<Real>& alpha,
                  std::span<const Index> cells);
  /// What strains the solid's cells near the zone, owned and halo; elsewhere what an earlier call
  /// left.
  const CellField<Tensor>& strain() const { return strain_; }
  /// Whether owned cell c is at a boundary whose velocity is given, or beside a cell at one.
  bool near_wall(Index c) const { return near_wall_[c] != 0; }
  /// The cells whose L and strain are those of here.
  const SimplexZone& zone() const { return zone_; }

 private:
  void clear_kinks();
  void set_kinks(const CellField<Tensor>& L, const Cuts& cuts, std::span<const Index> cells);
  void fit_cells(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                 const CellField<Real>& alpha, std::span<const Index> cells);

  const Mesh& mesh_;
  const SimplexZone& zone_;
  BoundarySides sides_;
  CellField<Real> deep_;         // 1: in the solid, with all vertex neighbours
  std::vector<char> near_wall_;  // [n_owned] 1: at a wall or beside a cell at one
  std::vector<Index> last_deep_;
  CellField<Tensor> strain_;
  std::vector<Index> beside_;  // cells of the solid that are not deep
  std::vector<Tensor> swept_;
  CellField<Vec3> kink_in_,
      kink_out_;  // what a kink adds to u, by the solid's and the fluid's side
  std::vector<Index> kinked_;
};

}  // namespace fsi::solid
