#pragma once
// Transport of the reference map xi: the map kinematics of a solid, and the memory.

#include <span>
#include <utility>
#include <vector>

#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/map_extension.hpp"
#include "libfsi/solid/strain.hpp"

namespace fsi::solid {

/// The map xi(x, t) is the place that the particle at x had in the undeformed solid:    [Kamrin12]
///   d xi/dt + u . grad xi = 0,   F = (grad xi)^-1,   J = det grad xi,   B = J^(2/dim) F F^T
/// The power of J makes det B = 1. Stored is xihat = xi - x (`d`), which is periodic where the mesh
/// is. A cell carries xihat if alpha >= alpha_known and it had a value before; in this file such a
/// cell is a known one. The cells around get xihat by MapExtension. A step over dt has phi and u
/// frozen and face values limited by Ko (koren.hpp), taken half a step back along the path of the
/// particles.
///
/// Volume. Each step lets the error J - 1 diffuse out of the solid, with J = 1 around it,
///   xi <- xi + nu_J h^2 grad xi . (Co grad J + (c_s dt / h) (grad J)_m),   nu_J = 0.06,
/// Co the Courant number of the cell. The term in c_s is for the memory alone. In cells with fluid
/// among their vertex neighbours (grad J)_m is the part along the normal m of the surface, in
/// others grad J itself. For the memory nu_J is 0.18 in triangles and tetrahedra, 0.12 with c_s.
///
/// Alternation. In the simplex zone the memory loses the same part gamma of its fourth differences
/// as psi (`Extension::fourth_difference_filter`). Over the known vertex neighbours k and their
/// images,
///   xi <- xi + gamma sum_k w_k (xi_k - xi - (grad xi + grad xi_k) / 2 . r_k) / sum_k w_k,
/// w_k = 1 / |r_k|^2. A velocity that alternates makes no lasting stress, but would distort the
/// map. Outside the zone the map, alone or as memory, loses the part s gamma. s is twice the
/// largest tangent of the angle between d and S at the cell, at most 1, so that orthogonal cells
/// lose nothing.
///
/// Films. In a cell that is left out at a film (WallFilm) the memory tends to that of its vertex
/// neighbours k farther in, as fast as psi tends to the memory by the flow,
///   xi <- xi + (1 - exp(-0.2 Co)) (sum_k w_k (xi_k - grad xi_k . r_k) / sum_k w_k - xi).
/// The velocity of such a cell is not quite that of the solid. A solid that slides along a wall
/// would distort its map there, and keep it when it leaves the wall. At rest the cells at the wall
/// remember that the solid farther in may not slip past them.
///
/// No other term changes xi, so a solid that returns to its place is undeformed again.
class ReferenceMap {
 public:
  /// `alone`: the map kinematics. The fluxes carry the map, and a map that folds is an error.
  /// `beside_psi`: the memory of log_conformation. Off the simplex zone it moves along the surface
  /// with the velocity that strains psi, so that both stay alike. In a cell where J has changed by
  /// a factor of two it takes the value that the extension gives.
  enum class Role { alone, beside_psi };
  /// Collective. walls: the patches whose velocity is given; used by the memory. symmetry: faces on
  /// the planes that cut the undeformed solid, beyond which the images of cells count as
  /// neighbours. A plane that the solid only reaches later is not among them, since what meets
  /// there came from elsewhere. mesh must outlive it.
  explicit ReferenceMap(const Mesh& mesh, Role role = Role::alone,
                        const std::vector<Patch>& walls = {}, const SymmetryFaces& symmetry = {});

  /// Below this fraction a cell has no stress: alpha is then rounding of the interface.
  static constexpr Real alpha_min = 1e-9;
  /// The part of the step after which the momentum equation takes the solid.
  static constexpr Real time_offset = 0.5;
  /// Whether B is set in cells around the solid as well.
  static constexpr bool extended = true;
  /// The longest step over the time in which the elastic wave passes a cell.
  static constexpr Real elastic_number = 1.5;

  /// Collective, before the map is set. faces: [n_boundary] 1 where the solid is bonded to a wall
  /// that stands still. xihat is 0 there.
  void hold(std::vector<char> faces);

  /// xi = x.
  void set_undeformed(const CellField<Real>& alpha);
  /// Collective. Sets anew what follows from d and alpha, after these were changed from outside.
  /// grad: not used.
  void resume(const CellField<Real>& alpha, CellField<SymGradient>& grad);

  /// Collective. Lists the cells that `transport` works on. alpha: of the end of the step.
  void mark(const CellField<Real>& alpha);
  /// Owned cells on which `transport` reads L.
  std::span<const Index> strain_cells() const { return known_.core(); }

  /// Collective, after `mark` with the same alpha. On return d is set on owned cells and halo, zero
  /// far from the solid. grad: not used. Errors: Error{numerics} where the map folds, det grad xi
  /// <= 0.
  Strain transport(const CellField<Real>& alpha, const FlowSnapshot& snapshot, Real dt,
                   CellField<SymGradient>& grad);

  /// Sets xi at the centre of the cell; then `resume`.
  void set_map(Index c, const Vec3& xi) { d[c] = xi - mesh_.C[c], is_set[c] = 1; }

  /// B and lambda, its largest eigenvalue, on the cells of the band. Returns the smallest
  /// eigenvalue of B among those with solid, at most 1.
  Real update_B(CellField<SymTensor>& B, CellField<Real>& lambda, const CellField<Real>& alpha,
                const Band& band) const;
  /// B of a cell, det B = 1. The unit tensor where there is no map, or where the extended map
  /// folds.
  SymTensor B(Index c, Real alpha) const;
  /// Trust vartheta in the map of a cell: 1 - |log2 J|, at least 0.
  Real trust(Index c) const;
  /// Whether the gradient of the map in an owned cell is one-sided at a wall.
  bool one_sided(Index c) const { return one_sided_[c] != 0; }
  /// grad xihat, where it is set; owned and halo.
  const CellField<Tensor>& slope() const { return slope_; }
  /// alpha of the last `mark` in the cells where xihat was set, else 0. The map in the rings comes
  /// from those of at least alpha_known. Owned and halo.
  const CellField<Real>& filled() const { return filled_; }
  /// Owned cells where d is set: the solid's and three rings around them.
  std::span<const Index> cells() const { return extension_.rings().all(); }
  /// J = det grad xi of a cell, which is 1 without an error of volume.
  Real volume_ratio(Index c) const { return det(gradient_of_map(c)); }

  CellField<Vec3> d;       ///< xihat = xi - x
  CellField<Real> is_set;  ///< 1 where d is set, else 0

 private:
  Tensor gradient_of_map(Index c) const;
  /// g_cf of face f (GradientStencil).
  const Vec3& weight(Index f, Index c) const {
    return mesh_.owner[f] == c ? of_owner_[f] : of_neighbour_[f];
  }
  /// Whether grad xi of the cell at face f is one-sided for it: a boundary face, but for planes of
  /// symmetry.
  bool has_one_side(Index f) const;
  /// Whether face f leads from known cell c to a cell that is not known.
  bool leaves_known(Index f, Index c) const;
  /// Whether known cell c has an unknown cell beyond a face, and neither c nor such a cell has a
  /// face on a wall.
  bool in_open_fluid(Index c) const;
  /// Mean of L over the known cells beyond the faces of c; L of c if there are none. It is the
  /// solid's L, while that of c itself has the kink of u at the surface.
  Tensor mean_of_known(const CellField<Tensor>& L, Index c) const;
  /// The upwind value of xihat at face f, half a step back along the path of the particles. out:
  /// whether the flow leaves cell c there.
  Vec3 face_value(Index f, Index c, bool out, const FlowSnapshot& snapshot, Real dt) const;
  Tensor gradient(Index c) const;
  /// What the flow takes out of cell c: sum_f phi_f (xi_f - xi_c) - grad xi . o.
  Vec3 outflow(Index c, const FlowSnapshot& snapshot, Real dt) const;
  /// The change of the map by the diffusion of J - 1 in dt.
  Vec3 towards_volume(Index c, const FlowSnapshot& snapshot, Real dt) const;
  /// The change of the map by the fourth-difference filter in dt.
  Vec3 without_alternation(Index c, const FlowSnapshot& snapshot, Real dt) const;
  /// The change of the map in dt in a known cell that is left out at a film, towards the map of the
  /// cells farther in.
  Vec3 towards_inside(Index c, const FlowSnapshot& snapshot, Real dt) const;
  void advance(const FlowSnapshot& snapshot, Real dt);
  void extend();
  bool folded() const;
  /// Collective. Cells with a trust of 0 get the value that the extension gives.
  void refit();

  const Mesh& mesh_;
  bool beside_psi_;
  CellField<Real> at_wall_;                    ///< 1 in cells with a face on a wall; owned and halo
  std::vector<Vec3> of_owner_, of_neighbour_;  ///< weights of the faces in the gradient of a cell
  std::vector<Real> lost_part_;                // [n_owned] part of gamma lost by alternation
  Band known_;
  MapExtension extension_;
  CellField<Real> filled_;                    // alpha where xihat is set
  CellField<Tensor> slope_;                   // grad xihat
  std::vector<char> one_sided_;               // owned; 1: one-sided at a wall
  std::vector<Vec3> new_;                     // in the order of the known cells
  std::vector<std::pair<Index, Real>> kept_;  // cells to refit and their alpha
};

}  // namespace fsi::solid
