#pragma once
// From the values each rank holds to one order that no division of the mesh changes, and back.

#include <span>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::io {

/// The place of every rank's items in the file order: cells by global_id; faces as on one rank
/// (internal by owner and neighbour, then patch by patch by owner).
/// Invariant: the places of the items that ranks own are a permutation of [0, size).
class Layout {
 public:
  /// Collective.
  Layout(const Mesh& mesh, On on);

  /// Items of the whole mesh.
  GlobalIndex size() const { return size_; }

  /// Collective. values: the rank's items, `width` Reals each (cells: owned ones). Rank 0 gets
  /// size * width Reals in file order, the others nothing: in `room`, on one rank the values
  /// themselves.
  std::span<const Real> gather(const Real* values, int width, std::vector<Real>& room) const;

  /// Collective. The reverse: rank 0's `all` fills every rank's items (halo cells excluded).
  void scatter(std::span<const Real> all, int width, Real* values) const;

 private:
  void place_cells(const Mesh& mesh);
  void place_faces(const Mesh& mesh, bool boundary_only);

  GlobalIndex size_ = 0;
  Index n_local_ = 0;
  /// Rank 0: [ranks][items] place, or its complement ~place where another rank owns the item. Empty
  /// on one rank, whose order is the file's.
  std::vector<std::vector<GlobalIndex>> places_;
};

/// Collective. Errors: Error{numerics} naming field, cell and place of a value that is not finite.
/// values: `width` Reals per item.
void require_finite(const std::string& name, const Real* values, int width, On on,
                    const Mesh& mesh);

}  // namespace fsi::io
