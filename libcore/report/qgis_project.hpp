// libcore/report/qgis_project.hpp: public
// A QGIS project (3.22 and later): layers in groups with their styles, and a print layout.
// in:    layers by their paths relative to the project
// out:   the XML of a .qgs
#pragma once

#include <array>
#include <string>
#include <vector>

namespace talus {

struct QgisLayer {
  enum Kind { raster, hillshade, contours, point, line, polygon };
  std::string group, name;  ///< groups stand in the order of their first layer, top first
  std::string source;       ///< relative to the project: "maps/reach.tif", "a.gpkg|layername=b"
  Kind kind = raster;
  std::string style;    ///< QML of the layer; not used for a hillshade and contours
  bool visible = true;  ///< when the project is opened
};

struct QgisProject {
  std::string title;
  std::string remark;                     ///< that runs failed: in the abstract of each layer
  std::string crs_wkt, crs_authid;        ///< "EPSG:31287"; either may be empty
  std::array<double, 4> extent{};         ///< x_min, y_min, x_max, y_max of the layout's map [m]
  std::vector<std::string> layout_lines;  ///< below the layout's title: what the map rests on
  double contour_interval = 0;            ///< of layers of that kind [m]
  std::vector<QgisLayer> layers;          ///< top to bottom
  bool is_edited = false;                 ///< layers of it are: new corners snap to those there are
};

/// Throws nothing; text is escaped. The layout takes the date and the scale when it is printed, and
/// who made it, for whom and which scenario from the project's variables (Project, Properties,
/// Variables: prepared_by, client, scenario).
[[nodiscard]] std::string qgis_project_xml(const QgisProject& project);

}  // namespace talus
