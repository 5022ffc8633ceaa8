// Signals that ask a tool to end early.
#include "tools/frame/stop_signals.hpp"

#include <atomic>
#include <csignal>

namespace talus {
namespace {

// Threads ask for it, and a signal handler sets it.
std::atomic<bool> signal_has_come = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void request_stop(int signal) {
  signal_has_come = true;
  // A line that is cut may be told of twice, by the terminal and by its shell: only a second order
  // of a person kills.
  if (signal != SIGHUP) std::signal(signal, SIG_DFL);
}

// A program started to outlive its terminal (nohup) continues to ignore its hangup.
void listen_for_hangup() {
  if (std::signal(SIGHUP, request_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

}  // namespace

void listen_for_signals() {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  listen_for_hangup();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool stop_requested() { return signal_has_come; }

}  // namespace talus
