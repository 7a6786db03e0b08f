#include "libfsi/run/continuation.hpp"

#include <gtest/gtest.h>

namespace fsi {
namespace {

TEST(Continuation, TellsOfATableWithAnotherContent) {
  const std::string goes_on = "goes on with other values than those of the checkpoint: ";
  EXPECT_EQ(differences("q in.csv [1]\n", "q in.csv [1]\n"), "");
  EXPECT_EQ(differences("q in.csv [1]\n", "q in.csv [2]\n"),
            goes_on + "-q in.csv (with another content)");
  EXPECT_EQ(differences("q in.csv [1]\n", "q out.csv [2]\n"), goes_on + "-q out.csv (was in.csv)");
  EXPECT_EQ(differences("q in.csv\n", "q in.csv [2]\n"), "");  // of a checkpoint without a check
}

}  // namespace
}  // namespace fsi
