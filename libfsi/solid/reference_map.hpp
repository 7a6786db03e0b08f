#pragma once
// Kinematics of the solid: transport of the reference map, where each particle once was.

#include <span>
#include <utility>
#include <vector>

#include "libfsi/solid/extension.hpp"
#include "libfsi/solid/flow_snapshot.hpp"
#include "libfsi/solid/map_extension.hpp"
#include "libfsi/solid/strain.hpp"

namespace fsi::solid {

/// The map xi(x, t) tells from where the particle at x came:            [Kamrin12]
///   d xi/dt + u . grad xi = 0,   F = (grad xi)^-1,   B = F F^T
/// Stored is d = xi - x, which goes on through a period of the mesh. Works on the cells that the
/// solid fills by alpha_known or more; the cells around get d by MapExtension. One step over dt
/// with phi and u frozen: face values by Koren's limiter, taken half a step back along the
/// particle's path. grad xi is the library's gradient over known and extended cells; B is divided
/// by (det B)^(1/dim), the error of volume that the map's transport leaves. Of that error J - 1,
/// J = det grad xi, each step takes some back: the map is moved along grad J,
///   xi <- xi + k h^2 grad xi . grad J,   k = 0.06 dt (rate of the cell's Courant number),
/// which lets J diffuse out of the solid, J = 1 around it. Beside psi k is twice that in triangles
/// and tetrahedra, and the rate of the wave, c / h, adds to that of the flow. The wave's part moves
/// cells with fluid among their vertex neighbours along the normal of the surface alone. Beside psi
/// and in the zone of simplices the map loses what alternates from cell to cell, as psi does there
/// (`Extension::fourth_difference_filter`). Over the known vertex neighbours k and their images,
///   xi <- xi + alternating_part sum w (xi_k - xi - (g + g_k) / 2 . r) / sum w,
/// g = grad xi, w = 1 / |r|^2. A velocity that alternates makes no stress that lasts, and would
/// take the map apart. Nothing else relaxes: what returns to its place is undeformed
/// again.
class ReferenceMap {
 public:
  /// A map alone tells the strain: carried by the fluxes, and where it folds that is an error.
  /// Beside psi it is carried along the surface by the velocity that strains psi off the zone of
  /// simplices, so that both stay alike. A cell in which it has lost its volume is then fitted to
  /// those around it, as where the solid is new.
  enum class Role { alone, beside_psi };
  /// Collective. walls: the patches that hold the velocity; used beside psi. symmetry: of the
  /// planes that cut the undeformed solid, beyond which the map goes on as its image. A plane that
  /// it only comes to later is none of them: what is there came from elsewhere. mesh must outlive
  /// it.
  explicit ReferenceMap(const Mesh& mesh, Role role = Role::alone,
                        const std::vector<Patch>& walls = {}, const SymmetryFaces& symmetry = {});

  /// Below this fraction a cell carries no stress: round-off of the interface.
  static constexpr Real alpha_min = 1e-9;
  /// Where in a step the solid stands when the momentum equation is solved.
  static constexpr Real time_offset = 0.5;
  /// Whether B is known around the solid as well.
  static constexpr bool extended = true;
  /// The longest step in units of the time in which the elastic wave passes a cell.
  static constexpr Real elastic_number = 1.5;

  /// xi = x.
  void set_undeformed(const CellField<Real>& alpha);
  /// Renews what follows from d and alpha: after these were changed from outside. Collective.
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

  /// B alone does not tell a map. Errors: always Error{input}.
  void set(Index c, const SymTensor& B, Real alpha);
  /// Sets where the particle at the centre of the cell came from; then `resume`.
  void set_map(Index c, const Vec3& xi) { d[c] = xi - mesh_.C[c], is_set[c] = 1; }

  /// B and lambda, its largest eigenvalue, on the cells of the band. Returns the smallest
  /// eigenvalue of B among those with solid, at most 1.
  Real update_B(CellField<SymTensor>& B, CellField<Real>& lambda, const CellField<Real>& alpha,
                const Band& band) const;
  /// B of a cell, det B = 1; the unit tensor where there is no map or the extended one folds.
  SymTensor B(Index c, Real alpha) const;
  /// How far the map of a cell is to be relied on: 1 - |log2 det grad xi|, at least 0.
  Real trust(Index c) const;
  /// grad d, where it is set; owned and halo.
  const CellField<Tensor>& slope() const { return slope_; }
  /// Owned cells where d is set: the solid's and three rings around them.
  std::span<const Index> cells() const { return extension_.rings().all(); }
  /// det grad xi of a cell: 1 but for the error of volume.
  Real volume_ratio(Index c) const { return det(gradient_of_map(c)); }

  CellField<Vec3> d;       ///< xi - x
  CellField<Real> is_set;  ///< 1 where d is set, else 0

 private:
  Tensor gradient_of_map(Index c) const;
  /// Whether face f leads from known cell c to one that does not know its map.
  bool leaves_known(Index f, Index c) const;
  /// Whether known cell c has fluid beside it, and no wall at it or at the cells of that fluid.
  bool in_open_fluid(Index c) const;
  /// Mean of L over the known cells beyond the faces of c: the solid's, while L of c has the kink
  /// of u at the surface; L of c where there are none.
  Tensor mean_of_known(const CellField<Tensor>& L, Index c) const;
  /// The upwind value of d at face f half a step back along the particle's path; out: the flow
  /// there leaves cell c.
  Vec3 face_value(Index f, Index c, bool out, const FlowSnapshot& snapshot, Real dt) const;
  Tensor gradient(Index c) const;
  /// What the error of volume moves the map by in dt.
  Vec3 towards_volume(Index c, const FlowSnapshot& snapshot, Real dt) const;
  /// What the filter moves the map by in dt.
  Vec3 without_alternation(Index c, const FlowSnapshot& snapshot, Real dt) const;
  void advance(const FlowSnapshot& snapshot, Real dt);
  void extend();
  bool folded() const;
  /// Collective. Gives the cells that are not to be relied on the value that the extension would
  /// give them.
  void refit();

  const Mesh& mesh_;
  bool beside_psi_;
  CellField<Real> at_wall_;  ///< 1 in cells with a face on a wall; owned and halo
  GradientStencil stencil_;
  Band known_;
  MapExtension extension_;
  CellField<Real> filled_;                    // alpha where d is set
  CellField<Tensor> slope_;                   // grad d
  std::vector<Vec3> new_;                     // beside the list of cells worked on
  std::vector<std::pair<Index, Real>> kept_;  // cells to refit and their alpha
};

}  // namespace fsi::solid
