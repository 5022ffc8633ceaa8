// libcore/import/contour_heights_gdal.hpp
// Lines and points of a contour map with their heights, which stand in the geometries' Z or in a
// field.
// in:    an open layer; the field that the user names, if any
// out:   lines in coordinates and units of the source
#pragma once

#include <string>
#include <vector>

#include "import/contour_layer_gdal.hpp"
#include "terrain/contours.hpp"

namespace talus {

/// Lowest and highest Z, in the unit of the lines.
struct HeightRange {
  double low = 0, high = 0;
  int first_sloping = -1;  ///< line that does not keep to one height, -1: none
};

[[nodiscard]] HeightRange heights_of(const Polylines& lines);

/// Contours: one height a line. Throws InputError where heights are missing, change along a line or
/// contradict one another.
[[nodiscard]] Polylines read_contour_lines(const ContourSources& sources, OpenLayer& source,
                                           ContourReading& reading);

/// Breaklines, or points as lines of one point: a height a point. Throws InputError where heights
/// are missing.
[[nodiscard]] Polylines read_measured_lines(const LayerChoice& choice, OpenLayer& source,
                                            std::vector<std::string>& notes, LayerReading& taken);

/// Whether the name of a field says that its numbers are feet: "ELEV_FT", "Height (ft)".
[[nodiscard]] bool is_in_feet(const std::string& name);

/// Sentences on what was passed over, and the remarks of a source, to its notes.
void add_remarks(const LayerReading& taken, std::vector<std::string>& notes);

}  // namespace talus
