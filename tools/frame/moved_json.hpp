// tools/frame/moved_json.hpp
// How much of the mass moved, as talus-dda and talus-runout write it to JSON.
// Keys: docs/reference/formats.md#run-out
#pragma once

#include "post/moved.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

[[nodiscard]] inline Json moved_json(const Moved& m) {
  return {{"released_t", m.mass / 1e3},
          {"share_moved_1_m", number_or_null(m.share)},
          {"share_moved_20_m", number_or_null(m.share_far)},
          {"displacement_p50_m", number_or_null(m.p50)},
          {"displacement_p90_m", number_or_null(m.p90)},
          {"displacement_p95_m", number_or_null(m.p95)},
          {"displacement_max_m", m.largest}};
}

}  // namespace talus
