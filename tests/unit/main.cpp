// Every unit test program: PETSc (and MPI) around GoogleTest. A failure on any rank fails the run,
// and so does a filter that no test matches.

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cstdio>

#include "libfsi/core/parallel.hpp"

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  if (fsi::rank() != 0) {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  const bool passed = fsi::all_of_ranks(RUN_ALL_TESTS() == 0);
  const bool listed = ::testing::GTEST_FLAG(list_tests);
  const bool any = listed || ::testing::UnitTest::GetInstance()->test_to_run_count() > 0;
  if (!any && fsi::rank() == 0) std::fprintf(stderr, "no test matches the filter\n");
  const int finalized = PetscFinalize();
  return passed && any && finalized == 0 ? 0 : 1;
}
