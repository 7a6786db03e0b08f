#include "libfsi/core/signals.hpp"

#include <atomic>
#include <csignal>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

// A handler may touch nothing else; the two variables of the library that outlive a call.
std::atomic<int> pending = 0;
std::atomic<int> unseen = 0;  // requests to end since anybody looked
static_assert(std::atomic<int>::is_always_lock_free);

constexpr int patience = 3;  // a scheduler and mpiexec may send one each

extern "C" void remember(int signal) {
  const int request = static_cast<int>(signal == SIGUSR1 ? Signal::checkpoint : Signal::end);
  int before = pending;
  while (before < request && !pending.compare_exchange_weak(before, request)) continue;
  if (request != static_cast<int>(Signal::end) || ++unseen < patience) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
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
  unseen = 0;
  return static_cast<Signal>(static_cast<int>(global_max(pending.exchange(0))));
}

}  // namespace fsi
