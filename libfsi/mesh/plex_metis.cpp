#include "libfsi/mesh/plex_metis.hpp"

#include <metis.h>
#include <petsc/private/partitionerimpl.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace fsi {
namespace {

static_assert(sizeof(idx_t) == sizeof(PetscInt));

/// Parts of the n graph vertices; balanced first, then with few edges cut. Empty on failure.
std::vector<idx_t> divide(PetscInt n_parts, PetscInt n, PetscInt start[], PetscInt adjacency[]) {
  std::vector<idx_t> parts(static_cast<std::size_t>(n), 0);
  if (n_parts == 1) return parts;
  if (n <= n_parts) {  // METIS divides no graph into single vertices
    std::iota(parts.begin(), parts.end(), 0);
    return parts;
  }
  idx_t options[METIS_NOPTIONS], constraints = 1, cut = 0;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // the same parts every time
  const bool few = n_parts <= 8;   // recursive bisection is the better one for few parts
  const auto method = few ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int code = method(&n, &constraints, start, adjacency, nullptr, nullptr, nullptr, &n_parts,
                          nullptr, nullptr, options, &cut, parts.data());
  if (code != METIS_OK) parts.clear();
  return parts;
}

PetscErrorCode partition(PetscPartitioner part, PetscInt n_parts, PetscInt n, PetscInt start[],
                         PetscInt adjacency[], PetscSection, PetscSection, PetscSection sizes,
                         IS* points) noexcept {
  PetscFunctionBegin;
  PetscMPIInt holders = n > 0 ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &holders, 1, MPI_INT, MPI_SUM, PetscObjectComm((PetscObject)part));
  PetscCheck(holders <= 1, PETSC_COMM_SELF, PETSC_ERR_SUP, "the graph must lie on one rank");
  const std::vector<idx_t> parts = divide(n_parts, n, start, adjacency);
  PetscCheck(parts.size() == static_cast<std::size_t>(n), PETSC_COMM_SELF, PETSC_ERR_LIB, "METIS failed");
  for (const idx_t p : parts) PetscCall(PetscSectionAddDof(sizes, p, 1));
  PetscCall(PetscSectionSetUp(sizes));
  std::vector<PetscInt> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](PetscInt a, PetscInt b) { return parts[a] < parts[b]; });
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, n, order.data(), PETSC_COPY_VALUES, points));
  PetscFunctionReturn(0);
}

}  // namespace

PetscErrorCode create_metis_partitioner(PetscPartitioner part) noexcept {
  part->noGraph = PETSC_FALSE;
  part->ops->partition = partition;
  return 0;
}

}  // namespace fsi
