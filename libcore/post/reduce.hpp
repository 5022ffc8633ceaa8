// libcore/post/reduce.hpp: public
// Runs without the frames between start and end, and many of them as one part.
// in:    runs, parts, the terrain
// out:   the data for every evaluation but paths, curves and the viewer
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "post/maps/map_rows.hpp"
#include "post/runout/runout.hpp"
#include "record/part_file.hpp"

namespace talus {

/// The run with its first and last frame, and with the reach that all of them told.
[[nodiscard]] RunFile without_frames(RunFile run, const Trn& trn, const ReachSettings& settings);

/// Two rows that summarise all of them: the first one, and the rest as one interval.
[[nodiscard]] std::vector<HealthRow> short_health(const std::vector<HealthRow>& rows);

/// Hands over the passages of a part, of each of its runs, cells of `factor` x `factor` recorded
/// ones whole, and at a time as many rows as `most` allows, or one row of such cells. `tile`: in
/// these larger cells.
void for_each_strip(const PartFile& file, int factor, const MapTile& tile, std::uint64_t most,
                    const std::function<void(const std::vector<std::vector<Passage>>&)>& take);

}  // namespace talus
