#pragma once
// The velocity's normal derivative at flat walls, of second order.

#include <span>
#include <vector>

#include "libfsi/field/boundary.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/gradient.hpp"

namespace fsi::flow {

/// The difference (u_b - u_P) / d is the derivative half way between a wall and the centre of its
/// cell, not at the wall. With a share omega of the cell's own gradient L it is that of a parabola:
///
///   S . grad u = g (u_b - u_P) + omega g {(u_b - u_P) - L_P . d},
///   omega = q_P / (-q_P - (grad q)_P . d),   q = (n . (x - x_b))^2,
///
/// with the discrete gradient of the stencil. By this omega the derivative of q at the wall is 0.
/// On uniform quadrilaterals or hexahedra omega = 2/3. Facets of a curved wall lie inside of it,
/// which brakes the fluid more, and the difference alone brakes it less. Both errors are of second
/// order and of about the same size. So omega falls to 0 as the normals of neighbouring faces turn
/// by up to 0.02 rad. Triangles and tetrahedra have none, and walls with a single cell between them
/// neither.
class WallParabola {
 public:
  /// The excess is explicit. In a channel two or more cells wide a step is stable for any viscosity
  /// if theta rises to this, with an omega of 1 at most.
  static constexpr Real theta_max = 0.75;

  /// Collective. stencil: of the velocity's gradient. mesh must outlive this.
  WallParabola(const Mesh& mesh, const std::vector<Condition>& conditions,
               const GradientStencil& stencil);

  /// Makes omega that of a wall without solids.
  void reset();
  /// Takes the part alpha of omega away, the largest alpha of the cell at the wall and of those
  /// around it: at the surface of a solid the derivative of u jumps. Once for each solid. alpha:
  /// owned and halo; cells: owned, those with solid and those around them.
  void keep_off(const CellField<Real>& alpha, std::span<const Index> cells);

  /// omega, [n_boundary]; 0 where there is no wall.
  const BoundaryField<Real>& share() const { return share_; }
  /// omega g {(u_b - u_P) - L_P . d} of the wall i of `walls`. u: owned and halo.
  Vec3 excess(std::size_t i, const CellField<Vec3>& u, const BoundaryField<Vec3>& u_b) const;
  /// rest_P += mu times that of all walls, over owned cells.
  void add_excess(CellField<Vec3>& rest, const FaceField<Real>& mu, const CellField<Vec3>& u,
                  const BoundaryField<Vec3>& u_b) const;
  /// Whether a wall on some rank has an omega.
  bool any() const { return any_; }
  /// The boundary faces with an omega, numbered from 0.
  std::span<const Index> walls() const { return walls_; }

 private:
  /// A value and its weight in L_P . d: that of a cell, or of a boundary face.
  struct Term {
    Index cell, face;
    Real weight;
  };
  void add_row(Index f, const GradientStencil& stencil, const std::vector<char>& slips,
               Real flatness);

  const Mesh& mesh_;
  const FaceWeights& weights_;
  std::vector<Index> walls_;     // [rows] boundary faces
  std::vector<Index> begin_{0};  // [rows + 1] of the terms
  std::vector<Term> terms_;
  BoundaryField<Real> share_, largest_;
  bool any_ = false;
};

}  // namespace fsi::flow
