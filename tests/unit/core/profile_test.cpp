#include "libfsi/core/profile.hpp"

#include <gtest/gtest.h>

#include "libfsi/core/clock.hpp"

namespace fsi {
namespace {

TEST(Profile, PhasesAddUpByName) {
  Profile profile;
  const int a = profile.add("first", "a"), b = profile.add("second", "b"),
            c = profile.add("third", "a");
  const Stopwatch watch;
  for (int i = 0; i < 3; ++i) {
    const Profile::Call call(profile, i == 0 ? a : c);
    const Stopwatch inner;
    while (inner.seconds() < 1e-3) continue;
  }
  const auto seconds = profile.seconds();
  EXPECT_GE(seconds.at("a"), 3e-3);
  EXPECT_LE(seconds.at("a"), watch.seconds());
  EXPECT_EQ(seconds.at("b"), 0);
  EXPECT_NE(a, b);
}

TEST(Profile, AnEventIsKnownToPetscOnce) {
  Profile first, second;
  first.add("once", "a"), second.add("once", "b");
  EXPECT_EQ(first.event(0), second.event(0));
}

}  // namespace
}  // namespace fsi
