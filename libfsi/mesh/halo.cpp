#include "libfsi/mesh/halo.hpp"

#include <petscsf.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi {

struct Halo::Exchange {
  /// The cells shared with each neighbour rank, in an order both agree on.
  struct Side {
    std::span<const PetscMPIInt> ranks;
    std::span<const PetscInt> offset, cells;
    std::vector<Real> buffer;
  };

  PetscSF sf = nullptr;
  Side owned, copies;               // cells sent, cells received
  std::vector<MPI_Datatype> units;  // units[w]: w Reals side by side
  std::vector<MPI_Request> requests;

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
  PetscInt n_from = 0, n_to = 0;
  const PetscMPIInt *from = nullptr, *to = nullptr;
  const PetscInt *from_offset = nullptr, *to_offset = nullptr, *copies = nullptr, *owned = nullptr;
  FSI_PETSC(PetscSFGetRootRanks(exchange_->sf, &n_from, &from, &from_offset, &copies, nullptr));
  FSI_PETSC(PetscSFGetLeafRanks(exchange_->sf, &n_to, &to, &to_offset, &owned));
  const auto side = [](auto count, auto* ranks, auto* offset, auto* cells) -> Exchange::Side {
    const auto size = static_cast<std::size_t>(count);
    if (size == 0) return {};
    return {{ranks, size}, {offset, size + 1}, {cells, static_cast<std::size_t>(offset[size])}, {}};
  };
  exchange_->copies = side(n_from, from, from_offset, copies);
  exchange_->owned = side(n_to, to, to_offset, owned);
}

void Halo::update(Real* values, int width) const {
  begin(values, values, width);
  end(values, values, width);
}

void Halo::begin(const Real* owned, Real* values, int width) const {
  if (exchange_ == nullptr) return;
  FSI_PETSC(PetscSFBcastBegin(exchange_->sf, exchange_->unit(width), owned, values, MPI_REPLACE));
}

void Halo::end(const Real* owned, Real* values, int width) const {
  if (exchange_ == nullptr) return;
  FSI_PETSC(PetscSFBcastEnd(exchange_->sf, exchange_->unit(width), owned, values, MPI_REPLACE));
}

void Halo::update(Real* values, int width, const Real* where) const {
  if (exchange_ == nullptr) return;
  auto& [sf, owned, copies, units, requests] = *exchange_;
  const MPI_Datatype unit = exchange_->unit(1);
  constexpr int tag = 1;
  requests.clear();
  // One message to and from each neighbour; both sides count the cells that travel.
  const auto count = [&](const Exchange::Side& side, std::size_t r) {
    const auto listed = side.cells.subspan(side.offset[r], side.offset[r + 1] - side.offset[r]);
    return width * static_cast<int>(
                       std::ranges::count_if(listed, [&](PetscInt c) { return where[c] != 0; }));
  };
  const auto reserve = [&](Exchange::Side& side) {
    side.buffer.resize(std::max(side.buffer.size(), width * side.cells.size()));
  };
  reserve(owned), reserve(copies);
  Real* at = copies.buffer.data();
  for (std::size_t r = 0; r < copies.ranks.size(); ++r) {
    const int n = count(copies, r);
    MPI_Irecv(at, n, unit, copies.ranks[r], tag, comm(), &requests.emplace_back());
    at += n;
  }
  at = owned.buffer.data();
  for (std::size_t r = 0; r < owned.ranks.size(); ++r) {
    Real* const begin = at;
    for (PetscInt i = owned.offset[r]; i < owned.offset[r + 1]; ++i)
      if (const PetscInt c = owned.cells[i]; where[c] != 0)
        at = std::copy_n(values + width * c, width, at);
    MPI_Isend(begin, static_cast<int>(at - begin), unit, owned.ranks[r], tag, comm(),
              &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  const Real* from = copies.buffer.data();
  for (const PetscInt c : copies.cells) {
    if (where[c] != 0) {
      std::copy_n(from, width, values + width * c);
      from += width;
    } else {
      std::fill_n(values + width * c, width, 0.0);
    }
  }
}

void Halo::add_to_owner(Real* values, int width) const {
  if (exchange_ == nullptr) return;
  const MPI_Datatype unit = exchange_->unit(width);
  FSI_PETSC(PetscSFReduceBegin(exchange_->sf, unit, values, values, MPI_SUM));
  FSI_PETSC(PetscSFReduceEnd(exchange_->sf, unit, values, values, MPI_SUM));
}

}  // namespace fsi
