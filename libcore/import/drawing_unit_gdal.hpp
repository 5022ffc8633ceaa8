// libcore/import/drawing_unit_gdal.hpp
// The unit that a drawing is drawn in, as its header says it.
// in:    a DXF file, also inside an archive (/vsizip/)
// out:   metres in one unit
// refs:  Autodesk, DXF reference, HEADER section ($INSUNITS)
#pragma once

#include <string>

#include "base/error.hpp"
#include "terrain/grid_frame.hpp"

namespace talus {

struct DrawingUnit {
  int code = 0;       ///< $INSUNITS; 0: the drawing does not say
  double metres = 0;  ///< in one unit; 0: not said, or not a length of maps
  std::string name;   ///< "feet"
};

/// Reads the header. A file that is not a DXF drawing says nothing.
[[nodiscard]] DrawingUnit drawing_unit(const std::string& path);

/// Warning: a header that says inches. GDAL (up to 3.10) and QGIS write that into every
/// drawing, and no map is drawn in inches, so it is taken to say nothing. Empty: no doubt.
[[nodiscard]] std::string doubt_on_unit(const std::string& path, double user_unit_m);

/// Options or commands: to the unit of the header, and to metres whatever that says.
struct DrawingWays {
  std::string as_said, as_metres;
};

/// Metres in one unit of a drawing: the unit of the user (not 0), else 1. Throws InputError at
/// `where` when the user says nothing and the header says another unit than that of the plan: a
/// metre, or `plan_unit_m` of the CRS. `extent`: of the coordinates in the file.
[[nodiscard]] double scale_of_drawing(const std::string& path, double user_unit_m,
                                      double plan_unit_m, const Where& where,
                                      const MapWindow& extent, const DrawingWays& ways);

}  // namespace talus
