// libcore/base/memory.hpp: public
// Memory is requested before it is used: work that may need much states how much, and is refused
// where the machine or the limit of the user (--memory-mb) does not allow it. A refusal is better
// than a process that the system kills without a message.
#pragma once

#include <cstddef>
#include <string>

#include "base/error.hpp"

namespace talus {

/// Sets how much more memory this process may take from now on [bytes]. 0: as much as is free on
/// this machine, as without a call.
void limit_memory(double bytes);

/// Throws InputError when `bytes` more are not available: "`where`: `what` need about 4,000 MB of
/// memory, expected at most 1,000 MB". `what` is a plural, `way_out` says how to need less. Less
/// than a megabyte is not checked, so that frequent calls are cheap.
void require_memory(double bytes, const Where& where, const std::string& what,
                    const std::string& way_out);

/// As require_memory, for the words and lines of a table with this content.
void require_memory_for_words(const std::string& content, const std::string& file);

/// Memory that a process can still take on this machine [bytes]: free memory and swap, but no more
/// than its control groups leave (containers, batch jobs). Infinite where the system does not say.
/// The system's files are read below `root`, for tests.
[[nodiscard]] double free_memory(const std::string& root = "");

}  // namespace talus
