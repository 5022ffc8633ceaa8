// libcore/io/burnt_dams_gdal.hpp: public
// Dams in the ground of a terrain file, as its tag says them.
// in:    a TRN, or its file
// out:   the tag, as JSON; the dams
#pragma once

#include <string>
#include <vector>

#include "terrain/trn.hpp"

namespace talus {

inline constexpr const char* dams_tag = "DAMS";

/// Of each dam `name`, `uphill` ("left" or "right" of its line), `crest_m` (map heights at the
/// points of the line) and `nodes` (first and last of each run of moved nodes, row by row). Empty
/// where there is none.
[[nodiscard]] std::string dams_text(const Trn& trn);

/// The dams in the file of `trn`; none where its heights were changed since. Throws InputError when
/// it cannot be opened, and for a tag that does not fit the terrain.
[[nodiscard]] std::vector<BurntDam> burnt_dams(const std::string& path, const Trn& trn);

}  // namespace talus
