#pragma once
// Work of one rank whose failure is an error on all ranks.

#include <mpi.h>

#include <string>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"

namespace fsi {

/// Collective. Runs `work` on rank 0; where it throws, every rank throws the same Error.
template <class Work>
void on_first_rank(const Work& work) {
  std::string fault;
  auto kind = static_cast<int>(ErrorKind::internal);
  if (rank() == 0) {
    try {
      work();
    } catch (const Error& error) {
      kind = static_cast<int>(error.kind()), fault = error.what();
    } catch (const std::exception& error) {
      fault = std::string("reading the mesh: ") + error.what();
    }
  }
  fault = broadcast(fault);
  MPI_Bcast(&kind, 1, MPI_INT, 0, comm());
  if (!fault.empty()) throw Error(static_cast<ErrorKind>(kind), fault);
}

}  // namespace fsi
