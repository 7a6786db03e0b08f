#pragma once
// Copies of a neighbour rank's cells, refreshed by one exchange.

#include <memory>
#include <span>

#include "libfsi/core/types.hpp"

namespace fsi {

/// The exchange that fills the halo part [n_owned, n_cells) of a cell array from the owners.
/// Invariant: send and receive lists of all ranks match. One rank: every update is free.
class Halo {
 public:
  Halo() noexcept;
  /// Collective. halo_owner[i], halo_owner_cell[i]: owning rank and its local cell number for local
  /// cell n_owned + i.
  Halo(Index n_owned, std::span<const int> halo_owner, std::span<const Index> halo_owner_cell);
  ~Halo();
  ///@{
  /// Moves the lists.
  Halo(Halo&&) noexcept;
  Halo& operator=(Halo&&) noexcept;
  ///@}
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;

  /// Collective. `values` holds n_cells items of `width` Reals, cell by cell.
  /// On return the halo part equals the owners' values, bit for bit. The first call with a width
  /// makes its buffers; later ones allocate nothing.
  void update(Real* values, int width) const;

  /// Collective. update() in two parts, with room for work between them: `owned` holds n_owned
  /// items and must stay as it is, of `values` only the halo part is written, by the time of end().
  void begin(const Real* owned, Real* values, int width) const;
  /// The second part: on return the halo part is set.
  void end(const Real* owned, Real* values, int width) const;

  /// update() of any field of Real, Vec3, SymTensor or Tensor.
  template <class Field>
  void update(Field& field) const {
    update(reinterpret_cast<Real*>(field.data()), components<typename Field::value_type>);
  }

  /// Collective. The same of a field that is zero but for the cells where `where` is not: only
  /// those travel, the halo's others become zero. `where`: n_cells, itself up to date in the halo.
  /// Allocates nothing once the most cells were sent.
  void update(Real* values, int width, const Real* where) const;
  /// update() of a field, where `where` is not zero.
  template <class Field, class Flags>
  void update(Field& field, const Flags& where) const {
    update(reinterpret_cast<Real*>(field.data()), components<typename Field::value_type>,
           where.data());
  }

  /// Collective. The reverse: adds every halo copy's value to the owner's cell; halo part
  /// unchanged.
  void add_to_owner(Real* values, int width) const;

 private:
  struct Exchange;  // PetscSF and one MPI datatype a width
  std::unique_ptr<Exchange> exchange_;
};

}  // namespace fsi
