#include "libfsi/core/signals.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

TEST(Signals, WhatOneRankReceivesAllKnowOnce) {
  watch_signals();
  EXPECT_EQ(pending_signal(), Signal::none);
  if (rank() == ranks() - 1) std::raise(SIGUSR1);
  EXPECT_EQ(pending_signal(), Signal::checkpoint);
  EXPECT_EQ(pending_signal(), Signal::none);
}

TEST(Signals, TheEndOutweighsACheckpoint) {
  watch_signals();
  for (const int signal : {SIGTERM, SIGINT, SIGUSR2}) {
    if (rank() == 0) std::raise(signal);
    std::raise(SIGUSR1);
    EXPECT_EQ(pending_signal(), Signal::end);
  }
}

TEST(Signals, TheThirdThatNobodySeesEndsTheProcess) {
  if (ranks() > 1) return;
  EXPECT_EXIT(
      {
        watch_signals();
        for (int i = 0; i < 2; ++i) std::raise(SIGTERM);
        if (pending_signal() != Signal::end) std::exit(1);
        for (int i = 0; i < 3; ++i) std::raise(SIGTERM);
        std::exit(2);
      },
      testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace fsi
