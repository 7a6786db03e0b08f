#pragma once
// From the values each rank holds to one order that no division of the mesh changes, and back.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "libfsi/core/types.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/mesh/mesh.hpp"

namespace fsi::io {

/// The place of every rank's items in the file order: cells by global_id; faces as on one rank
/// (internal by owner and neighbour, then patch by patch by owner). Every rank looks after a
/// stretch of that order, as long as each other's. Invariant: the places of the items that ranks
/// own are a permutation of [0, size).
class Layout {
 public:
  /// Collective.
  Layout(const Mesh& mesh, Location on);
  ~Layout();
  ///@{
  /// Moves the lists.
  Layout(Layout&&) noexcept;
  Layout& operator=(Layout&&) noexcept;
  ///@}
  Layout(const Layout&) = delete;
  Layout& operator=(const Layout&) = delete;

  /// Items of the whole mesh, and this rank's stretch of them.
  GlobalIndex size() const { return size_; }
  /// The first item of this rank's stretch.
  GlobalIndex first() const { return first_; }
  /// Count of items of this rank's stretch.
  GlobalIndex mine() const { return mine_; }

  /// Collective. values: the rank's items, `width` Reals each (cells: owned ones). Every rank gets
  /// the mine * width Reals of its stretch in file order: in `room`, on one rank the values
  /// themselves.
  std::span<const Real> gather(const Real* values, int width, std::vector<Real>& room) const;

  /// Collective. The reverse: the stretches of all ranks fill every rank's items (halo cells
  /// excluded).
  void scatter(std::span<const Real> stretch, int width, Real* values) const;

 private:
  struct Exchange;
  void connect(const std::vector<GlobalIndex>& places);
  std::vector<GlobalIndex> places_of_faces(const Mesh& mesh, bool boundary_only);

  GlobalIndex size_ = 0, first_ = 0, mine_ = 0;
  Index n_local_ = 0;
  std::unique_ptr<Exchange> exchange_;  ///< none on one rank, whose order is the file's
};

/// Collective. Errors: Error{numerics} naming field, cell and place of a value that is not finite.
/// values: `width` Reals per item.
void require_finite(const std::string& name, const Real* values, int width, Location on,
                    const Mesh& mesh);

}  // namespace fsi::io
