#include "stop_signals.hpp"

#include <csignal>

namespace talus {
namespace {

volatile std::sig_atomic_t signal_has_come = 0;

void request_stop(int signal) {
  signal_has_come = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void listen_for_signals() {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool stop_requested() { return signal_has_come != 0; }

}  // namespace talus
