#include "libfsi/core/parallel.hpp"

#include <petscsys.h>

#include <array>
#include <cstddef>
#include <memory_resource>
#include <numeric>
#include <vector>

namespace fsi {
namespace {

template <class T>
T reduced(T value, MPI_Datatype type, MPI_Op op) {
  T result{};
  MPI_Allreduce(&value, &result, 1, type, op, comm());
  return result;
}

}  // namespace

MPI_Comm comm() { return PETSC_COMM_WORLD; }

int rank() {
  int r = 0;
  MPI_Comm_rank(comm(), &r);
  return r;
}

int ranks() {
  int n = 1;
  MPI_Comm_size(comm(), &n);
  return n;
}

Real global_min(Real value) { return reduced(value, MPI_DOUBLE, MPI_MIN); }
Real global_max(Real value) { return reduced(value, MPI_DOUBLE, MPI_MAX); }
GlobalIndex global_sum(GlobalIndex value) { return reduced(value, MPI_INT64_T, MPI_SUM); }
bool all_of_ranks(bool holds) { return reduced(holds ? 1 : 0, MPI_INT, MPI_MIN) == 1; }

Real exact_sum(std::span<const Real> items) {
  Sum sum;
  for (const Real item : items) sum.add(item);
  return sum.total();
}

Real Sum::total_of(Real high, Real low) {
  Sum sum;
  sum.high_ = high, sum.low_ = low;
  Real result = 0;
  totals({&result, 1}, {&sum, 1});
  return result;
}

void Sum::totals(std::span<Real> items, std::span<const Sum> parts) {
  const std::size_t n = parts.size();
  // On the stack, but for thousands of ranks: sums are taken in every step.
  constexpr std::size_t bytes = 32768;
  alignas(Real) std::array<std::byte, bytes> room;  // NOLINT: left unset
  std::pmr::monotonic_buffer_resource memory(room.data(), room.size());
  std::pmr::vector<Real> mine(2 * n, &memory);
  std::pmr::vector<Real> all(2 * n * static_cast<std::size_t>(ranks()), &memory);
  for (std::size_t i = 0; i < n; ++i) mine[2 * i] = parts[i].high_, mine[2 * i + 1] = parts[i].low_;
  const int count = static_cast<int>(2 * n);
  MPI_Allgather(mine.data(), count, MPI_DOUBLE, all.data(), count, MPI_DOUBLE, comm());
  for (std::size_t i = 0; i < n; ++i) {
    Sum sum;
    for (std::size_t r = 0; r < all.size(); r += 2 * n)
      sum.add(all[r + 2 * i]), sum.low_ += all[r + 2 * i + 1];
    items[i] = sum.high_ + sum.low_;
  }
}

std::vector<Real> gathered(std::span<const Real> items) {
  const int mine = static_cast<int>(items.size());
  std::vector<int> count(static_cast<std::size_t>(ranks())), begin(count.size());
  MPI_Allgather(&mine, 1, MPI_INT, count.data(), 1, MPI_INT, comm());
  std::exclusive_scan(count.begin(), count.end(), begin.begin(), 0);
  std::vector<Real> all(static_cast<std::size_t>(begin.back() + count.back()));
  MPI_Allgatherv(items.data(), mine, MPI_DOUBLE, all.data(), count.data(), begin.data(), MPI_DOUBLE,
                 comm());
  return all;
}

std::string broadcast(std::string text, int root) {
  auto size = static_cast<std::int64_t>(text.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, root, comm());
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, root, comm());
  return text;
}

}  // namespace fsi
