// libcore/io/trn_digest.hpp: public
// Digest of a terrain, in 64 digits: ties blocks and runs to the ground that they were made for.
#pragma once

#include <string>

#include "terrain/trn.hpp"

namespace talus {

/// SHA-256 of the grid's place on the map, its cell size and its elevations; the same for a TRN in
/// memory and for the one read back from its file.
[[nodiscard]] std::string trn_digest(const Trn& trn);

}  // namespace talus
