#pragma once
// Exchange of items between all ranks, and the rank that holds an item.

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "libfsi/core/parallel.hpp"
#include "libfsi/core/types.hpp"

namespace fsi {

/// What came from every rank: items[begin[r]] .. items[begin[r + 1]] from rank r.
template <class T>
struct Received {
  std::vector<T> items;    ///< from all ranks
  std::vector<int> begin;  ///< [ranks + 1]
};

/// Collective. to[r] goes to rank r. T is copied as bytes.
template <class T>
Received<T> exchange(std::vector<std::vector<T>> to) {
  const auto n = static_cast<std::size_t>(ranks());
  std::vector<int> sent(n), received(n), sent_at(n + 1, 0), received_at(n + 1, 0);
  for (std::size_t r = 0; r < n; ++r) sent[r] = static_cast<int>(to[r].size());
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm());
  for (std::size_t r = 0; r < n; ++r) {
    sent_at[r + 1] = sent_at[r] + sent[r], received_at[r + 1] = received_at[r] + received[r];
  }
  std::vector<T> out;
  out.reserve(static_cast<std::size_t>(sent_at[n]));
  for (auto& items : to) {
    out.insert(out.end(), items.begin(), items.end());
    items = {};
  }
  std::vector<T> in(static_cast<std::size_t>(received_at[n]));
  MPI_Datatype item = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  MPI_Alltoallv(out.data(), sent.data(), sent_at.data(), item, in.data(), received.data(),
                received_at.data(), item, comm());
  MPI_Type_free(&item);
  return {std::move(in), std::move(received_at)};
}

/// Items 0, 1, 2 ... of which every rank holds a stretch, rank after rank.
struct Stretches {
  std::vector<Index> begin;  ///< [ranks + 1]

  /// Collective. From the number of items each rank holds.
  static Stretches of(Index mine) {
    Stretches all{std::vector<Index>(static_cast<std::size_t>(ranks()) + 1, 0)};
    MPI_Allgather(&mine, 1, MPI_INT32_T, all.begin.data() + 1, 1, MPI_INT32_T, comm());
    for (std::size_t r = 1; r < all.begin.size(); ++r) all.begin[r] += all.begin[r - 1];
    return all;
  }
  /// n items in stretches as long as each other.
  static Stretches even(Index n) {
    Stretches all;
    for (std::int64_t r = 0; r <= ranks(); ++r) {
      all.begin.push_back(static_cast<Index>(n * r / ranks()));
    }
    return all;
  }
  /// The rank that holds an item.
  int holder(Index item) const {
    const auto after = std::upper_bound(begin.begin(), begin.end(), item);
    return static_cast<int>(after - begin.begin()) - 1;
  }
  /// The first item of this rank.
  Index first() const { return begin[static_cast<std::size_t>(rank())]; }
  /// Count of items of this rank.
  Index mine() const { return begin[static_cast<std::size_t>(rank()) + 1] - first(); }
  /// Count of all items.
  Index size() const { return begin.back(); }
};

}  // namespace fsi
