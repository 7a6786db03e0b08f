#pragma once
// METIS as a partitioner of PETSc.

#include <petscpartitioner.h>

namespace fsi {

/// The constructor to register under the name "metis". The graph must lie on one rank.
PetscErrorCode create_metis_partitioner(PetscPartitioner part) noexcept;

}  // namespace fsi
