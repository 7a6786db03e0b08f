#include "libfsi/core/signals.hpp"

#include <atomic>
#include <csignal>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

// A handler may touch nothing else; the one variable of the library that outlives a call.
std::atomic<int> pending = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void remember(int signal) {
  const int request = static_cast<int>(signal == SIGUSR1 ? Signal::checkpoint : Signal::end);
  int before = pending;
  while (before < request && !pending.compare_exchange_weak(before, request)) continue;
}

}  // namespace

void watch_signals() {
  std::signal(SIGUSR1, remember);
  std::signal(SIGUSR2, remember);
  std::signal(SIGTERM, remember);
  std::signal(SIGINT, remember);
  if (std::signal(SIGHUP, remember) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGPIPE, SIG_IGN);  // who reads the output may leave
}

Signal pending_signal() {
  return static_cast<Signal>(static_cast<int>(global_max(pending.exchange(0))));
}

}  // namespace fsi
