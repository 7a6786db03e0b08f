#pragma once
// All ranks' items on rank 0.

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "libfsi/core/parallel.hpp"

namespace fsi::io {

/// Collective. Rank 0: the items of every rank, [ranks][items]; the others: nothing. T is copied as
/// bytes.
template <class T>
std::vector<std::vector<T>> collect(const std::vector<T>& mine) {
  constexpr int tag = 72;
  const auto n = static_cast<std::int64_t>(mine.size());
  std::vector<std::int64_t> counts(static_cast<std::size_t>(ranks()));
  MPI_Gather(&n, 1, MPI_INT64_T, counts.data(), 1, MPI_INT64_T, 0, comm());
  MPI_Datatype item = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  std::vector<std::vector<T>> all;
  if (rank() == 0) all.push_back(mine);
  if (rank() != 0) MPI_Send(mine.data(), static_cast<int>(n), item, 0, tag, comm());
  for (int r = 1; rank() == 0 && r < ranks(); ++r) {
    std::vector<T>& other = all.emplace_back(counts[static_cast<std::size_t>(r)]);
    const int count = static_cast<int>(other.size());
    MPI_Recv(other.data(), count, item, r, tag, comm(), MPI_STATUS_IGNORE);
  }
  MPI_Type_free(&item);
  return all;
}

}  // namespace fsi::io
