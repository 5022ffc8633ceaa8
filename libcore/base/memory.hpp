// libcore/base/memory.hpp: public
// Memory is asked for before it is taken: work that can need much says how much, and is refused
// where the machine, or who runs the tool (--memory-mb), does not have so much. A refusal is worth
// more than a process that the system ends without a word.
#pragma once

#include <cstddef>
#include <string>

#include "base/error.hpp"

namespace talus {

/// Sets the most that this process may take from now on [bytes], beyond what it has taken already.
/// 0: what is free on this machine, as without a call.
void limit_memory(double bytes);

/// Throws InputError when `bytes` more are not to be had: "`where`: `what` need about 4,000 MB of
/// memory, expected at most 1,000 MB". `what` in the plural, `way_out` says how to need less. Less
/// than a megabyte is not looked at, so that it may be asked often.
void require_memory(double bytes, const Where& where, const std::string& what,
                    const std::string& way_out);

/// As require_memory, for the words and lines of a table with this content.
void require_memory_for_words(const std::string& content, const std::string& file);

/// What a process can still take on this machine [bytes]: free memory and swap, but no more than
/// its control groups leave (containers, batch jobs). Infinite where the system does not say. The
/// system's files are read below `root`, for tests.
[[nodiscard]] double free_memory(const std::string& root = "");

}  // namespace talus
