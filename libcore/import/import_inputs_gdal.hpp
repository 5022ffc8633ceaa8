// libcore/import/import_inputs_gdal.hpp: public
// The only import of vector data, from any source that OGR reads: contour maps, points of the
// ground, reference points, and objects on the ground. Each question (which layer, where are the
// heights, which system, which units, is it plausible) is put once, to all layers of a request.
// in:    a request
// out:   metres, x to the east, y to the north, z in one system of heights
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "import/layer_reading.hpp"
#include "import/request.hpp"
#include "import/vectors_gdal.hpp"
#include "terrain/contours.hpp"

namespace talus {

/// Contours, breaklines, spot heights and boundary, or points of the ground as spots of a map
/// without contours. All is in the frame of the request. The origin is the lower left corner of the
/// ground, floored to 100 m (z: 0). Throws InputError where anything is missing or cannot be true:
/// see docs/tools/talus-tin.md. Laser scans are refused with the command that makes
/// text of them, and a file of talus-import that was changed since.
[[nodiscard]] ContourMap import_map(const InputsRequest& request, ImportReading& reading);

/// The inputs of a site: its ground, without points where the request has none, and the objects on
/// it, in the order of the request.
struct Imported {
  ContourMap map;
  std::vector<VectorShapes> shapes;
};
/// As import_map(), and each layer of a site as read_vectors().
[[nodiscard]] Imported import_inputs(const InputsRequest& request, ImportReading& reading);

/// The refusal of a sealed file; `layer` is one of its own.
[[nodiscard]] InputError changed_since(const std::string& layer);

/// SHA-256 of all coordinates of a map.
[[nodiscard]] std::string map_digest(const ContourMap& map);

/// Points with a height in map coordinates, in `crs_wkt` [m]: reference for a terrain. A
/// missing CRS, of the source or in `crs_wkt`, means the same one. Throws InputError.
[[nodiscard]] std::vector<Vec3> import_reference_points(const LayerRef& ref,
                                                        const std::string& crs_wkt,
                                                        ImportReading& reading);

}  // namespace talus
