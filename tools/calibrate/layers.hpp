// tools/calibrate/layers.hpp
// Observations beside results, as layers and as JSON. Keys:
// docs/tools/talus-calibrate.md
#pragma once

#include <vector>

#include "ensemble/run_set.hpp"
#include "io/geopackage_gdal.hpp"
#include "post/observed/calibrate.hpp"
#include "post/observed/observed.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// observed_boulders, observed_scars and observed_outlines, as far as there are any. `origin`: map
/// coordinates of the local zero [m].
[[nodiscard]] std::vector<VectorLayer> observed_layers(const std::vector<ObservedEvent>& events,
                                                       const std::vector<EventScore>& scores,
                                                       const Vec3& origin);

[[nodiscard]] Json event_json(const ObservedEvent& event, const EventScore& score,
                              const Vec3& origin);

/// `runs`: those that were judged.
[[nodiscard]] Json calibration_json(const Calibration& calibration,
                                    const std::vector<RunMember>& runs);

}  // namespace talus
