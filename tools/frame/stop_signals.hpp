// tools/frame/stop_signals.hpp
// How a tool is asked to end early.
#pragma once

namespace talus {

/// From here on SIGINT, SIGTERM and SIGHUP ask the work to end where it can, and a second SIGINT or
/// SIGTERM kills; a SIGHUP that was ignored at the start (nohup) stays so. A closed pipe and a
/// limit on file sizes are errors of the write, as a full disk is.
void listen_for_signals();

/// SIGINT, SIGTERM or SIGHUP has come.
[[nodiscard]] bool stop_requested();

}  // namespace talus
