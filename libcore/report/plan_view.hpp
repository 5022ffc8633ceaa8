// libcore/report/plan_view.hpp: public
// A map of a run as SVG: where the mass started, the path of each block, where it came to rest.
#pragma once

#include <string>

#include "record/run_file.hpp"
#include "report/map_sheet.hpp"
#include "report/texts.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Part of a map, local coordinates [m].
struct PlanWindow {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
};
/// All frames and lines of a run and a quarter more on each side, within the terrain; all of the
/// terrain for a run without frames and lines.
[[nodiscard]] PlanWindow plan_window(const RunFile& run, const Trn& trn);

/// Throws nothing; a run without frames shows no paths.
[[nodiscard]] std::string plan_view_svg(const Texts& texts, const RunFile& run,
                                        const MapSheet& sheet);

}  // namespace talus
