// tools/stop_signals.hpp
// How a tool is asked to end early.
#pragma once

namespace talus {

/// From here on SIGINT and SIGTERM ask the work to end where it can, and a second one kills; a
/// closed pipe and a limit on file sizes are errors of the write, as a full disk is.
void listen_for_signals();

/// SIGINT or SIGTERM has come.
[[nodiscard]] bool stop_requested();

}  // namespace talus
