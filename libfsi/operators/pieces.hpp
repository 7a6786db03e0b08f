#pragma once
// The pieces that a solid is in.

#include <algorithm>
#include <vector>

#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi {

/// Collective. Marks with 1 + rings, on owned cells and halo, become 1. So do cells in `rings`
/// rings of vertex neighbours around them for which open(c) holds. All others become 0.
template <class Open>
void spread_marks(CellField<Real>& marks, int rings, const Mesh& mesh, const Open& open) {
  // A cell holds the count of rings that are left beyond it and itself.
  for (int left = rings; left > 0; --left) {
    for (Index c = 0; c < mesh.n_owned; ++c)
      if (marks[c] == 0 && open(c) && std::ranges::any_of(mesh.cell_neighbours[c], [&](Index n) {
            return marks[n] == 1 + left;
          }))
        marks[c] = left;
    mesh.halo.update(marks);
  }
  for (Index c = 0; c < mesh.n_cells; ++c) marks[c] = marks[c] > 0 ? 1 : 0;
}

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
