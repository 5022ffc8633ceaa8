// libcore/io/trn_file_gdal.hpp: public
// The terrain file.
// in:    a TRN
// out:   GeoTIFF with AREA_OR_POINT=Point
#pragma once

#include <map>
#include <string>

#include "terrain/trn.hpp"

namespace talus {

/// Metadata of a TRN file besides its elevations.
struct TrnFileOptions {
  std::map<std::string, std::string> tags;  ///< metadata, e.g. RUN_ID
  std::string accepted_doubts = {};         ///< places that the user accepted; empty: none
};

/// Writes a tiled, deflated GeoTIFF of Float64 node elevations, AREA_OR_POINT=Point, nodata -9999,
/// to `path`, byte by byte the same for the same TRN and options. The file says that its heights
/// were judged: the writer of a TRN has judged it, or made it from one that was. Throws InputError
/// when it cannot be written whole.
void write_trn(const std::string& path, const Trn& trn, const TrnFileOptions& options = {});

}  // namespace talus
