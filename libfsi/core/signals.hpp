#pragma once
// Requests from outside a run: checkpoint, or end in order.

namespace fsi {

/// What was asked for since the last question.
enum class Signal : int {
  none = 0,
  checkpoint = 1,  ///< SIGUSR1: write a checkpoint and go on
  end = 2,  ///< SIGUSR2, SIGTERM, SIGINT, SIGHUP: finish the step, write a checkpoint, end as
            ///< interrupted
};

/// Installs the handlers. SIGPIPE is ignored, and so stays SIGHUP where it is. A third request to
/// end that nobody has asked for ends the process at once.
void watch_signals();
/// Collective. The strongest request any rank received; it is then forgotten.
Signal pending_signal();

}  // namespace fsi
