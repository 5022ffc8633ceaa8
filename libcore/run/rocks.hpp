// libcore/run/rocks.hpp
// Rocks that fall one by one: a few at a time from start to end, in threads. Of a finished rock
// only its part of the run file is kept; its bits do not depend on threads.
// in:    a Runner of such rocks
// out:   the same with more rocks done
#pragma once

#include <functional>

#include "run/run_data.hpp"

namespace talus {

/// Whether the rocks of a run are computed so: none meets another, and there are more than a few.
[[nodiscard]] bool fall_in_batches(const Scene& scene, const RunOptions& options);

/// Computes the next thousand rocks to their end, or fewer where RunOptions::is_stopped says so.
/// `fall` makes a whole run of a scene of a few of them, its file up to date; any thread calls it.
void advance_rocks(Runner& runner, const std::function<Runner(const Scene&)>& fall);

}  // namespace talus
