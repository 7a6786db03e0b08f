#pragma once
// A preconditioner for a matrix that is far from its diagonal in some of the cells.

#include <vector>

#include "libfsi/operators/linear_system_vector.hpp"

namespace fsi {

/// Approximates the inverse of a VectorMatrix with positive diagonal: one symmetric sweep of
/// Gauss-Seidel over the couplings among the stiff cells of this rank, division by the diagonal
/// elsewhere. With D, L the diagonal and the lower triangle among stiff cells it is
/// (D + L^T)^-1 D (D + L)^-1, symmetric and positive definite. Stiff is a cell whose off-diagonal
/// coefficients exceed in sum a share of its diagonal.
class StiffSweep {
 public:
  /// Of no matrix yet. mesh must outlive it.
  explicit StiffSweep(const Mesh& mesh);

  /// The matrix has new values. Allocates only where more cells are stiff than ever.
  void renew(const VectorMatrix& matrix);
  /// z = M r, dim values an owned cell.
  void apply(Real* z, const Real* r) const;
  /// Stiff cells of this rank.
  Index stiff() const { return static_cast<Index>(cell_.size()); }

 private:
  const Mesh& mesh_;
  std::vector<Real> inverse_;  // [n_owned * dim] of the diagonal
  std::vector<char> marked_;   // [n_owned] stiff
  std::vector<Index> cell_;    // the stiff cells, ascending
  // Row i, that of cell_[i], couples to the stiff cells before it: [begin_[i], begin_[i + 1]).
  std::vector<Index> begin_, before_;
  std::vector<Real> coefficient_;
};

}  // namespace fsi
