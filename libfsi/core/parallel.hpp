#pragma once
// Values that all ranks share: sums, extremes, agreement. Every function is collective.

#include <mpi.h>

#include <span>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"

namespace fsi {

/// The communicator of the run (PETSC_COMM_WORLD).
MPI_Comm comm();
/// Number of this rank, from 0.
int rank();
/// Count of ranks.
int ranks();

/// The least of the ranks' values.
Real global_min(Real value);
/// The largest of the ranks' values.
Real global_max(Real value);
/// The sum of the ranks' values.
GlobalIndex global_sum(GlobalIndex value);
/// True where it holds on every rank.
bool all_of_ranks(bool holds);

/// Sum over all ranks of all items, carried in twice the working precision: the result does not
/// depend on the number of ranks beyond the last bit.
Real exact_sum(std::span<const Real> items);

/// The same, built term by term in a kernel: add() in any order, then total().
class Sum {
 public:
  /// Error-free addition [Knuth] two-sum.
  void add(Real value) {
    const Real s = high_ + value, b = s - high_;
    low_ += (high_ - (s - b)) + (value - b);
    high_ = s;
  }
  /// Adds all terms of another one.
  void add(const Sum& other) { add(other.high_), low_ += other.low_; }
  /// Collective. The sum over all ranks.
  // The parts go by value, so that a loop over add() can keep them in registers.
  Real total() const { return total_of(high_, low_); }
  /// Collective. Several sums in one exchange: items[i] becomes the total of parts[i].
  static void totals(std::span<Real> items, std::span<const Sum> parts);

 private:
  static Real total_of(Real high, Real low);

  Real high_ = 0, low_ = 0;
};

/// The items of all ranks, in the order of the ranks.
std::vector<Real> gathered(std::span<const Real> items);

/// Rank `root`'s text on every rank.
std::string broadcast(std::string text, int root = 0);

}  // namespace fsi
