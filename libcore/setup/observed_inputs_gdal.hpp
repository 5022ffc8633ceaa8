// libcore/setup/observed_inputs_gdal.hpp: public
// Observations on a slope, as [observed.*] of a site name them: read, checked, in local
// coordinates.
#pragma once

#include <vector>

#include "base/input_log.hpp"
#include "setup/observed.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Of all [observed.*], in the order of the file. Throws InputError for a section without a file,
/// invalid volumes and heights, scars without a height, and a layer that lies outside of the
/// known terrain; points outside of it are left out with a warning.
[[nodiscard]] std::vector<ObservedEvent> observed_events(InputLog& log, const Site& site,
                                                         const Trn& trn);

}  // namespace talus
