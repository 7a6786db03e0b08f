#pragma once
// plicRDF: planes whose normals follow the gradient of a reconstructed distance [Scheufler19].

#include <vector>

#include "libfsi/vof/interface.hpp"

namespace fsi::vof {

/// Finds the planes of a volume fraction field. Keeps scratch and the last normals as the first
/// guess of the next call; the guess is part of a checkpoint (Interface::normal).
class Reconstruct {
 public:
  explicit Reconstruct(const Mesh& mesh);

  /// Collective. alpha: owned and halo. On return `interface` holds a plane in every interface
  /// cell, cutting off exactly alpha, halo included. Iterates
  ///   psi_i = sum_j w_ij n_j . (x_i - c_j) / sum_j w_ij,  w_ij = (n_j . (x_i - c_j))^2 / |x_i -
  ///   c_j|^2, n_i = grad psi / |grad psi|                          [Scheufler19] (14), (15), (17)
  /// over the cells that share a vertex, until the mean of 1 - n . n_old is below 1e-6, at most
  /// five times, and once where the last call's normals are the guess: they are one step old, and
  /// further iterations only turn the normals of filaments thinner than the stencil (reversed
  /// vortex, 128^2, T = 8: shape error 2.5e-3 with one, 3.3e-3 with five). Returns the iterations.
  int operator()(Interface& interface, const CellField<Real>& alpha);

  /// Collective. Finds the cells and planes of alpha with the normals that `interface` holds.
  void renew(Interface& interface, const CellField<Real>& alpha);

 private:
  void find_cells(Interface& interface, const CellField<Real>& alpha);
  bool first_normals(Interface& interface, const CellField<Real>& alpha);
  void cut(Interface& interface, const CellField<Real>& alpha);
  void distance(const Interface& interface);
  Real turn(Interface& interface);

  const Mesh& mesh_;
  CellField<Real> psi_;
  std::vector<Index> near_;          // owned cells with an interface cell around
  std::vector<std::int32_t> stamp_;  // [n_owned] last call that listed the cell
  std::int32_t calls_ = 0;
  Csr halo_neighbours_;      // owned cells around every halo cell
  std::vector<Vec3> guess_;  // beside Interface::cells
  geometry::Cell cell_;
};

/// Gradient at cell c by least squares over the cells that share a vertex, weights 1 / d^2.
/// Directions without information (2-D: z) give zero.
Vec3 least_squares_gradient(const CellField<Real>& q, const Mesh& mesh, Index c);

}  // namespace fsi::vof
