#include "libfsi/core/clock.hpp"

#include <gtest/gtest.h>

namespace fsi {
namespace {

TEST(Clock, StepsLandOnEventsAndOnTheEnd) {
  Clock clock(1);
  Every event(0.25);
  int events = 0, steps = 0;
  EXPECT_TRUE(event.due(0));
  while (clock.running()) {
    const Real dt = clock.step(0.07, event.next(clock.t()));
    EXPECT_GT(dt, 0.03);
    clock.set(clock.t() + dt);
    ++steps;
    if (event.due(clock.t())) {
      ++events;
      EXPECT_NEAR(clock.t(), 0.25 * events, 1e-12);
    }
  }
  EXPECT_EQ(events, 4);
  EXPECT_EQ(steps, 16);
  EXPECT_NEAR(clock.t(), 1, 1e-14);
}

TEST(Clock, AnEventWithoutIntervalNeverFires) {
  Every event(0);
  EXPECT_FALSE(event.due(0));
  EXPECT_FALSE(event.due(5));
}

TEST(Clock, EveryMultipleIsReachedOnce) {
  Every event(0.5);
  EXPECT_EQ(event.reached(0.3), std::vector<Real>{0});
  EXPECT_EQ(event.reached(1.6), (std::vector<Real>{0.5, 1, 1.5}));
  EXPECT_TRUE(event.reached(1.9).empty());
  EXPECT_EQ(event.last(1.9), 1.5);
  EXPECT_EQ(event.reached(2 - 1e-12), std::vector<Real>{2});
}

TEST(Clock, ResumeForgetsWhatLiesBefore) {
  Every event(0.5);
  event.resume(1.2);
  EXPECT_FALSE(event.due(1.3));
  EXPECT_TRUE(event.due(1.5));
}

}  // namespace
}  // namespace fsi
