#pragma once
// The pieces that a solid is in.

#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// The pieces of a solid: the sets of cells with alpha > 1/2 that are connected by their corners,
/// also across a period.
class Pieces {
 public:
  /// No pieces. mesh must outlive it.
  explicit Pieces(const Mesh& mesh);

  /// Collective. Finds the pieces. alpha: owned and halo.
  void find(const CellField<Real>& alpha);

  /// Whether there are two or more.
  bool several() const { return several_; }
  /// Collective. Count of the pieces whose solid, sum alpha V, is `least` or more. alpha: that of
  /// the last `find`.
  int count(const CellField<Real>& alpha, Real least) const;
  /// Collective. A crumb is a piece with less than a hundredth of the volume of the largest one.
  /// Sets `near` to 1 in the crumbs and in `rings` rings of vertex neighbours around them that are
  /// in no piece, to 0 elsewhere; owned and halo. alpha: that of the last `find`.
  void mark_crumbs(CellField<Real>& near, const CellField<Real>& alpha, int rings) const;

 private:
  struct Volume {
    Real number, volume;
  };
  Index root(Index c);
  void spread();
  /// Collective. The volume of each piece. Allocates, as do its callers.
  std::vector<Volume> volumes(const CellField<Real>& alpha) const;

  const Mesh& mesh_;
  std::vector<Index> cells_;   // with alpha > 1/2, owned and halo, ascending
  std::vector<Index> parent_;  // of a rank's cells that were found to hang together
  CellField<Real> number_;     // of the piece: the least global number of its cells
  bool several_ = false;
};

}  // namespace fsi
