#include "libfsi/core/signals.hpp"

#include <csignal>

#include "libfsi/core/parallel.hpp"

namespace fsi {
namespace {

// A handler may touch nothing else; the one variable of the library that outlives a call.
volatile std::sig_atomic_t pending = 0;

extern "C" void remember(int signal) {
  const int request = signal == SIGUSR1 ? 1 : 2;
  if (request > pending) pending = request;
}

}  // namespace

void watch_signals() {
  std::signal(SIGUSR1, remember);
  std::signal(SIGUSR2, remember);
  std::signal(SIGTERM, remember);
}

Signal pending_signal() {
  const int mine = pending;
  pending = 0;
  return static_cast<Signal>(static_cast<int>(global_max(mine)));
}

}  // namespace fsi
