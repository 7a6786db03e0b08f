#pragma once
// The film of fluid between a solid and a wall that it comes to.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::solid {

/// The rule of films (doc/theory/walls.md). A solid that comes to a wall has a film of fluid
/// between them, which may be thinner than a cell. The wall fixes the velocity on one side of the
/// film only, so the gradient of the velocity in a cell at the wall strains the solid the wrong
/// way. Such a cell counts as unknown, and its faces on the wall have no shear stress of the solid.
/// A solid that touches a wall at the start is bonded to it there, and the rule does not apply.
class WallFilm {
 public:
  /// Collective. walls: their patches. bonded: [n_boundary] 1 on faces of owned cells that the
  /// undeformed solid touches. mesh must outlive it.
  WallFilm(const Mesh& mesh, const std::vector<Patch>& walls, const std::vector<char>& bonded);

  /// Collective. Sets `fraction` from the fraction of the solid, owned and halo. A cell at a film
  /// is left out if the cells farther in can tell its strain: a vertex neighbour off the films is
  /// known, and so is a face neighbour of that one.
  void set(const CellField<Real>& fraction);

  /// mu = mu_f at the faces with a film that have solid in their cell: as if the film were half a
  /// cell thick.
  void set_viscosity(FaceField<Real>& mu, const CellField<Real>& alpha, Real mu_f) const;
  /// The next two, after `set_viscosity` of all solids, for those whose films have a thickness: mu
  /// of the film. Let d be the distance of the cell's centre from the wall, and (1 - alpha_f) d
  /// that of the surface. The fluid between them bears u_wall - u_c:
  ///   mu = mu_f / max(1 - alpha_f, thickness / d).
  /// Where several of them share the cell, alpha_f is their sum, and the largest thickness counts.
  void thin(FaceField<Real>& mu, const CellField<Real>& alpha, const FaceField<Real>& alpha_f,
            Real mu_f) const;
  /// The bound by the thickness, above 0; after `thin` of all solids.
  void bound_viscosity(FaceField<Real>& mu, const CellField<Real>& alpha, Real mu_f,
                       Real thickness) const;

  /// Collective. The largest distance of a cell's centre from its face with a film; 0: no film.
  Real largest_depth() const;

  /// The fraction of the solid without the cells that are left out; owned and halo.
  const CellField<Real>& fraction() const { return fraction_; }
  /// [n_boundary] 1 on faces with a film.
  const std::vector<char>& faces() const { return faces_; }
  /// Whether owned or halo cell c has a face with a film.
  bool at_film(Index c) const { return at_film_[c] > 0; }

 private:
  /// Distance of the cell's centre from boundary face f.
  Real depth(Index f) const;
  /// Whether boundary face f has a film, and its cell solid.
  bool covers(Index f, const CellField<Real>& alpha) const;

  const Mesh& mesh_;
  CellField<Real> at_film_;         // 1 in cells with a film; owned and halo
  CellField<Real> known_;           // 1 in known cells of beside_ that tell the strain
  CellField<Real> fraction_;        // of the solid, without the cells left out
  std::vector<char> faces_;         // [n_boundary]
  std::vector<Index> at_, beside_;  // owned: with a film, and others with a vertex of such a cell
};

}  // namespace fsi::solid
