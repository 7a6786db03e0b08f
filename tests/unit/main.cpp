// Every unit test program: PETSc (and MPI) around GoogleTest; a failure on any rank fails the run.

#include <gtest/gtest.h>
#include <petscsys.h>

#include "libfsi/core/parallel.hpp"

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  if (fsi::rank() != 0) {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  const bool passed = fsi::all_of_ranks(RUN_ALL_TESTS() == 0);
  const int finalized = PetscFinalize();
  return passed && finalized == 0 ? 0 : 1;
}
