// libcore/base/processor_time.hpp: public
// Processor time of the process, of all its threads, user and system. POSIX.
#pragma once

#include <ctime>

namespace talus {

/// Since the process began [s]; to a nanosecond.
[[nodiscard]] inline double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace talus
