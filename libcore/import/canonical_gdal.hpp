// libcore/import/canonical_gdal.hpp: public
// The file behind the border: what was imported, in metres, x to the east, y to the north, z in one
// system of heights, with the decisions that made it so.
// in:    layers that were read
// out:   a sealed GeoPackage; a request that reads it without a question
#pragma once

#include <optional>
#include <string>

#include "import/layer_reading.hpp"
#include "import/request.hpp"
#include "terrain/contours.hpp"

namespace talus {

/// How large the coordinates of each layer are: goes to `reading`.
void measure(const ContourMap& map, ImportReading& reading);

/// Layers contours or points, breaklines, spots and boundary, and the tables `decisions` and
/// `magnitudes`. `source_feature` is the id of a line in the file that it comes from. The same map
/// and reading give the same bytes. Throws InputError when it cannot be written.
void write_canonical(const std::string& path, const ContourMap& map, const ImportReading& reading);

/// The request for the layers of such a file; nothing for another one, or a layer of it that is
/// named. import_map() refuses it where it was changed since.
[[nodiscard]] std::optional<InputsRequest> canonical_request(const std::string& path);

}  // namespace talus
