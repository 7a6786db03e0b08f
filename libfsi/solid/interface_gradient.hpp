#pragma once
// The velocity gradient of the simplex zone at a solid: a quadratic fit of one side, of second
// order.

#include <span>
#include <utility>
#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/symmetry_faces.hpp"
#include "libfsi/solid/simplex_zone.hpp"

namespace fsi::solid {

/// Where the surface cuts cells, and what a kink of u there adds to their velocity. With l the
/// distance of the cell's centre from the surface, positive in the fluid, and j the jump of the
/// normal derivative, a cut cell has the velocity u_S + j l_+. Here u_S is the linear velocity of
/// the solid's side, and l_+ takes the place of max(0, l) (KinkProfile). All fields are owned and
/// halo.
struct Cuts {
  const CellField<Real>& alpha;       ///< fraction of the solid
  const CellField<Vec3>& normal;      ///< n_hat, out of the solid; zero in cells that are not cut
  const CellField<Real>& solid_side;  ///< l_+, by which u = u_S + j l_+
  const CellField<Real>& fluid_side;  ///< l_+ - l, by which u = u_F + j (l_+ - l), u_F likewise
};

/// The velocity at faces of the boundary. At an opening there is neither a given velocity nor an
/// image. There the boundary value is made from the cell's own and is no information on the
/// gradient.
struct BoundarySides {
  std::vector<char>
      given{};  ///< [n_boundary] 1 on walls and inlets, where u is given; empty: everywhere
  SymmetryFaces symmetry{};  ///< planes beyond which the images of cells count as neighbours
};

/// Sets L in the listed cells of the simplex zone: the known cells of the solid and all their
/// vertex neighbours.
///
/// A triangle is not symmetric about its centre. The error of its quasi-Green gradient is a part of
/// h grad grad u that changes sign from cell to cell, and the strain accumulates it. At the surface
/// u has a kink. There a gradient over both sides also has an error of a part of the jump, and the
/// non-orthogonal part of the viscous flux adds that error to the velocity.
///
/// Here L follows from a quadratic fit (QuadraticFit) to the values of the vertex neighbours on the
/// cell's own side of alpha = 1/2. Their images beyond a plane of symmetry and the velocities of
/// walls at the cell's faces count too. Cells of the solid with fluid among their vertex neighbours
/// also fit the gradients of neighbours that have none. The fit may amplify errors too much, where
/// the solid, or the fluid beside it, is thinner than the stencil. There L stays the quasi-Green
/// gradient, which changes with the velocity as the stress acts on it. A fit to few values of one
/// side does not, and with it a thin strand of solid in a corner of a cavity can make the flow
/// diverge.
///
/// The velocity of a cut cell is neither that of the solid's side nor that of the fluid's. The fit
/// of the solid's side takes u - j l_+, that of the fluid's u - j (l_+ - l) (Cuts), with
///   j = (I - n_hat n_hat) . (L_out - L_in) . n_hat.
/// j has no normal part, since div u = 0 on both sides. L_in and L_out are means over the vertex
/// neighbours on either side, weighted with alpha and 1 - alpha. They come from a first fit without
/// j.
class InterfaceGradient {
 public:
  /// mesh and zone must outlive it.
  InterfaceGradient(const Mesh& mesh, const SimplexZone& zone, BoundarySides sides = {});

  /// Collective. cells: owned, as above. L on entry: the quasi-Green gradient; L, u: owned and
  /// halo.
  void apply(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
             const Cuts& cuts, std::span<const Index> cells);

  /// Collective, after `apply` with the same L, u, u_b, alpha and cells, which hold all known cells
  /// of the solid. Sets `strain` in the solid's cells. It is L in cells whose vertex neighbours all
  /// have alpha >= 1/2 and allow the fit, and in cells near a wall. In all other cells it is fitted
  /// to pairs with the known vertex neighbours k,
  ///   min over L_c of sum_k w_k |u_k - u_c - (L_c + L_k) / 2 . r_k|^2,   w_k = 1 / |r_k|^2,
  /// and to u_b as in `one_sided_gradient`. Four Jacobi sweeps solve for all L_c together. In the
  /// first sweep L_c stands in place of L_k if k is itself such a cell. The result is exact for
  /// linear u, and each sweep reduces the error for a quadratic u.
  ///
  /// A quadratic fit of one side amplifies the errors of its few values. The sweeps amplify an L
  /// that alternates from cell to cell. In a solid wedged between walls such an L takes up more
  /// energy than the force gives, and the strain grows at a rate of G / (3 mu). So cells near a
  /// wall keep the quadratic fit.
  void set_strain(const CellField<Tensor>& L, const CellField<Vec3>& u,
                  const BoundaryField<Vec3>& u_b, const CellField<Real>& alpha,
                  std::span<const Index> cells);
  /// The L that strains the solid's cells near the zone, owned and halo; in other cells out of
  /// date.
  const CellField<Tensor>& strain() const { return strain_; }
  /// Whether owned cell c is near a wall: has a face on one, or shares a vertex with such a cell.
  bool near_wall(Index c) const { return near_wall_[c] != 0; }
  /// The simplex zone, whose cells get their L and strain here.
  const SimplexZone& zone() const { return zone_; }

 private:
  void clear_kinks();
  void set_kinks(const CellField<Tensor>& L, const Cuts& cuts, std::span<const Index> cells);
  void fit_cells(CellField<Tensor>& L, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b,
                 const CellField<Real>& alpha, std::span<const Index> cells);

  const Mesh& mesh_;
  const SimplexZone& zone_;
  BoundarySides sides_;
  CellField<Real> deep_;         // 1: of the solid, as are all its vertex neighbours
  std::vector<char> near_wall_;  // [n_owned] 1: near a wall
  std::vector<Index> last_deep_;
  CellField<Tensor> strain_;
  std::vector<Index> beside_;  // cells of the solid that are not deep and not near a wall
  std::vector<Tensor> swept_;
  CellField<Vec3> kink_in_,
      kink_out_;  // j l_+ and j (l_+ - l)
  std::vector<Index> kinked_;
};

}  // namespace fsi::solid
