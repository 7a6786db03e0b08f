#include "libfsi/core/signals.hpp"

#include <gtest/gtest.h>

#include <csignal>

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

}  // namespace
}  // namespace fsi
