#pragma once
// The interface as planes, one in each cell that holds both solid and fluid.

#include <cstdint>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/field/fraction.hpp"
#include "libfsi/geometry/cut.hpp"
#include "libfsi/mesh/mesh.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi::vof {

/// The plane in one cell.
struct Piece {
  Vec3 n_hat;     ///< unit normal out of the solid, toward alpha = 0; zero where there is no plane
  Vec3 centre;    ///< centroid of the part of the plane inside the cell
  Real area = 0;  ///< of that part (length in 2-D)
};

/// The interface in all cells of this rank, halo included.
struct Interface {
  /// No planes.
  explicit Interface(const Mesh& mesh) : piece(mesh) {}
  std::vector<Index> cells;  ///< owned cells with a plane, ascending
  CellField<Piece> piece;    ///< owned and halo cells
};

/// When the rounds for the normals end; the defaults are those of [Scheufler19]. Planes are exact
/// in the limit of many rounds. If a film is thinner than the stencil, more rounds make them worse.
struct ReconstructAccuracy {
  int max_rounds = 5;  ///< rounds at most
  Real turn = 1e-6;    ///< mean over the interface of 1 - cos of the turn of a normal in a round
  Real turn_of_bend = 0.1;  ///< the same as a part of the mean 1 - cos between neighbours' normals
};

/// Scratch of `reconstruct`, made once; grows with the interface, never shrinks.
struct ReconstructScratch {
  /// planes: of symmetry, beyond which the solid has an image. mesh must outlive it.
  explicit ReconstructScratch(const Mesh& mesh, SymmetryFaces planes = {});

  SymmetryFaces symmetry;            ///< these planes
  Csr halo_neighbours;               ///< [n_cells - n_owned] owned cells that touch a halo cell
  CellField<Real> distance;          ///< reconstructed distance near the interface
  std::vector<Index> cells;          ///< owned cells with alpha between the limits
  std::vector<Index> near;           ///< owned cells that touch one of those, or are one
  std::vector<std::uint8_t> marked;  ///< [n_owned] whether the cell is in `near`
  std::vector<SymTensor> fit;        ///< [cells] inverse moments of the least-squares gradient
  std::vector<Vec3> normal;          ///< [cells]
  geometry::Polytope cell;           ///< scratch
};

/// Collective. plicRDF [Scheufler19]: normals from a least-squares gradient of alpha, then rounds
/// of: cut the cells, reconstruct the signed distance to the planes around them, take its gradient
/// for normals. The result depends on alpha alone, not on the steps before. On the number of ranks
/// it depends by rounding only. In planes of symmetry cells and planes have images (`for_images`).
/// alpha: owned and halo set. On return owned cells and halo of
/// `interface` are set; cells where the gradient of alpha vanishes have no plane.
void reconstruct(Interface& interface, const CellField<Real>& alpha, const Mesh& mesh,
                 ReconstructScratch& scratch, const ReconstructAccuracy& accuracy = {});

/// The boundary of owned cell c, coordinates relative to C[c].
void gather(geometry::Polytope& cell, const Mesh& mesh, Index c);

}  // namespace fsi::vof
