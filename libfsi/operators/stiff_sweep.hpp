#pragma once
// A preconditioner for a matrix with large couplings in some of the cells.

#include <vector>

#include "libfsi/operators/linear_system_vector.hpp"

namespace fsi {

/// Approximates the inverse of a VectorMatrix with positive diagonal. A cell is stiff if the sum of
/// its off-diagonal coefficients exceeds a share of its diagonal. Over the couplings among the
/// stiff cells of this rank it is one symmetric Gauss-Seidel sweep, in other cells a division by
/// the diagonal. With the diagonal D and the lower triangle L among stiff cells it is
/// (D + L^T)^-1 D (D + L)^-1, symmetric and positive definite.
class StiffSweep {
 public:
  /// Of no matrix yet. mesh must outlive it.
  explicit StiffSweep(const Mesh& mesh);

  /// The matrix has new values. Allocates only if more cells are stiff than in all calls before.
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
