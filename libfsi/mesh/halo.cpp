#include "libfsi/mesh/halo.hpp"

#include <petscsf.h>

#include <utility>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi {

struct Halo::Exchange {
  PetscSF sf = nullptr;
  std::vector<MPI_Datatype> units;  // units[w]: w Reals side by side

  Exchange() = default;
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;
  ~Exchange() {
    for (MPI_Datatype& unit : units) {
      if (unit != MPI_DATATYPE_NULL) MPI_Type_free(&unit);
    }
    PetscSFDestroy(&sf);  // NOLINT: a destructor has nobody to tell
  }

  /// One Real is MPI_DOUBLE itself: PETSc passes a type derived of a single one on to
  /// MPI_Reduce_local, which sums only types of MPI's own.
  MPI_Datatype unit(int width) {
    if (width == 1) return MPI_DOUBLE;
    const auto w = static_cast<std::size_t>(width);
    if (units.size() <= w) units.resize(w + 1, MPI_DATATYPE_NULL);
    if (units[w] == MPI_DATATYPE_NULL) {
      MPI_Type_contiguous(width, MPI_DOUBLE, &units[w]);
      MPI_Type_commit(&units[w]);
    }
    return units[w];
  }
};

Halo::Halo() noexcept = default;
Halo::~Halo() = default;
Halo::Halo(Halo&&) noexcept = default;
Halo& Halo::operator=(Halo&&) noexcept = default;

Halo::Halo(Index n_owned, std::span<const int> halo_owner, std::span<const Index> halo_owner_cell) {
  if (ranks() == 1) return;
  exchange_ = std::make_unique<Exchange>();
  const std::size_t n = halo_owner.size();
  std::vector<PetscInt> leaf(n);
  std::vector<PetscSFNode> root(n);
  for (std::size_t i = 0; i < n; ++i) {
    leaf[i] = n_owned + static_cast<PetscInt>(i);
    root[i] = {halo_owner[i], halo_owner_cell[i]};
  }
  FSI_PETSC(PetscSFCreate(comm(), &exchange_->sf));
  FSI_PETSC(PetscSFSetGraph(exchange_->sf, n_owned, static_cast<PetscInt>(n), leaf.data(),
                            PETSC_COPY_VALUES, root.data(), PETSC_COPY_VALUES));
  FSI_PETSC(PetscSFSetUp(exchange_->sf));
}

void Halo::update(Real* values, int width) const {
  if (exchange_ == nullptr) return;
  const MPI_Datatype unit = exchange_->unit(width);
  FSI_PETSC(PetscSFBcastBegin(exchange_->sf, unit, values, values, MPI_REPLACE));
  FSI_PETSC(PetscSFBcastEnd(exchange_->sf, unit, values, values, MPI_REPLACE));
}

void Halo::add_to_owner(Real* values, int width) const {
  if (exchange_ == nullptr) return;
  const MPI_Datatype unit = exchange_->unit(width);
  FSI_PETSC(PetscSFReduceBegin(exchange_->sf, unit, values, values, MPI_SUM));
  FSI_PETSC(PetscSFReduceEnd(exchange_->sf, unit, values, values, MPI_SUM));
}

}  // namespace fsi
