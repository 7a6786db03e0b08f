#include "libfsi/core/parallel.hpp"

#include <gtest/gtest.h>

namespace fsi {
namespace {

TEST(Parallel, SumIsExactWhereAPlainOneIsNot) {
  Sum sum;
  sum.add(1e16);
  for (int i = 0; i < 1000; ++i) sum.add(1);
  sum.add(-1e16);
  EXPECT_EQ(sum.total(), 1000.0 * ranks());
}

TEST(Parallel, AgreementNeedsEveryRank) {
  EXPECT_TRUE(all_of_ranks(true));
  EXPECT_EQ(all_of_ranks(rank() != 0), false);
}

TEST(Parallel, BroadcastGivesTheRootsText) {
  EXPECT_EQ(broadcast("rank " + std::to_string(rank())), "rank 0");
}

}  // namespace
}  // namespace fsi
