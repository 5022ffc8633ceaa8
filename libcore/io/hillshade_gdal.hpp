// libcore/io/hillshade_gdal.hpp: public
// A shaded picture of a terrain: a wrong one is seen in a second.
#pragma once

#include <string>

#include "terrain/trn.hpp"

namespace talus {

/// PNG of the nodes, a pixel each, lit from four sides (mostly north-west); unknown nodes are
/// black. Throws InputError when it cannot be written.
void write_hillshade(const std::string& path, const Trn& trn);

}  // namespace talus
