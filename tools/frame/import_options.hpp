// Properties of data as users declare them: one declaration for the tools that import.
// in:    the command line
// out:   a request; a record of the data read
#pragma once

#include <string>
#include <vector>

#include "import/layer_reading.hpp"
#include "import/request.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// Systems of coordinates and heights, as they are written.
struct CrsOptions {
  std::string crs, t_srs, vertical_crs, t_vertical;
  bool accept_ballpark = false;
};
void declare_crs_options(Tool& tool, CrsOptions& options);

/// Throws UsageError for a name that is not a system.
[[nodiscard]] SystemsByUser systems_by_user(const CrsOptions& options);

/// A contour map, or points of the ground, and its options.
struct ImportOptions {
  LayerRef contours, labels, breaklines, spots, boundary;
  bool of_points = false;
  double elevation_unit_m = 0;
  std::vector<std::string> fields, units;  ///< "elev", "spots=hoehe"; "0.3048", "spots=0.3048"
  CrsOptions crs;
};
/// All but `contours`.
void declare_import_options(Tool& tool, ImportOptions& options);

/// The layers that are given, with the options for each; their further files become inputs. Of a
/// file that talus-import wrote its own layers. Throws UsageError for options beside it, which give
/// properties that it settles.
[[nodiscard]] InputsRequest request_of(Tool& tool, ImportOptions& options);

/// Reports and records the data read and the changes to them.
void say_reading(Tool& tool, const ImportReading& reading);

/// For options in metres: "" for a number above 0, or of 0 or more, else the fault.
[[nodiscard]] std::string check_positive(const std::string& word);
[[nodiscard]] std::string check_not_negative(const std::string& word);

}  // namespace talus
