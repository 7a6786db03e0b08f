#include "libfsi/core/clock.hpp"

#include <gtest/gtest.h>

#include "libfsi/core/memory.hpp"

namespace fsi {
namespace {

TEST(Clock, StepsLandOnEventsAndOnTheEnd) {
  Clock clock(1);
  Schedule event(0.25);
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

TEST(Clock, AStepIsNotSplitForATimeThatItMustNotPass) {
  const Clock clock(1);
  const auto step = [&](Real limit, Real not_past) { return clock.step(limit, {1, not_past}); };
  EXPECT_EQ(step(0.1, 0.15), 0.1) << "up to there";
  EXPECT_EQ(step(0.2, 0.15), 0.15);
  EXPECT_EQ(step(0.8, 0.15), 0.15);
  EXPECT_EQ(step(0.8, 0.7), 0.5) << "half of the way to the end";
}

TEST(Clock, AnEventWithoutIntervalNeverFires) {
  Schedule event(0);
  EXPECT_FALSE(event.due(0));
  EXPECT_FALSE(event.due(5));
}

TEST(Clock, EveryMultipleIsReachedOnce) {
  Schedule event(0.5);
  EXPECT_EQ(event.reached(0.3), std::vector<Real>{0});
  EXPECT_EQ(event.reached(1.6), (std::vector<Real>{0.5, 1, 1.5}));
  EXPECT_TRUE(event.reached(1.9).empty());
  EXPECT_EQ(event.last(1.9), 1.5);
  EXPECT_EQ(event.reached(2 - 1e-12), std::vector<Real>{2});
}

TEST(Clock, ResumeForgetsWhatLiesBefore) {
  Schedule event(0.5);
  event.resume(1.2);
  EXPECT_FALSE(event.due(1.3));
  EXPECT_TRUE(event.due(1.5));
}

TEST(Forecast, GoesByTheTimeGainedAndNotByTheLastStep) {
  Forecast forecast(2);
  EXPECT_DOUBLE_EQ(forecast.seconds_left(10, 3, 12), 90) << "0.1 a second";
  EXPECT_DOUBLE_EQ(forecast.seconds_left(20, 6, 12), 30) << "0.3 and 0.1: 0.2";
  EXPECT_DOUBLE_EQ(forecast.seconds_left(30, 6, 12), 60) << "slower and slower";
  EXPECT_DOUBLE_EQ(forecast.seconds_left(30, 6, 12), 60) << "at once";
  EXPECT_DOUBLE_EQ(forecast.seconds_left(40, 12, 12), 0);
  Forecast stuck;
  EXPECT_EQ(Forecast::text(stuck.seconds_left(1, 0, 1)), "more than 10 days");
}

TEST(Forecast, IsNeverAnAbsurdNumber) {
  EXPECT_EQ(Forecast::text(0), "0 s");
  EXPECT_EQ(Forecast::text(59.6), "60 s");
  EXPECT_EQ(Forecast::text(863999), "863999 s");
  EXPECT_EQ(Forecast::text(1e6), "more than 10 days");
  EXPECT_EQ(Forecast::text(1e30), "more than 10 days");
  EXPECT_EQ(Forecast::text(std::numeric_limits<Real>::quiet_NaN()), "more than 10 days");
}

TEST(Memory, IsThatOfThisMachineInReadableUnits) {
  EXPECT_GT(memory_limit(), 1'000'000u);
  EXPECT_EQ(text_of_bytes(999), "999 bytes");
  EXPECT_EQ(text_of_bytes(1500), "1.5 kB");
  EXPECT_EQ(text_of_bytes(250'000'000), "250 MB");
  EXPECT_EQ(text_of_bytes(1ull << 42), "4.4 TB");
}

}  // namespace
}  // namespace fsi
