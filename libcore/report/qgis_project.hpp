// libcore/report/qgis_project.hpp: public
// Content of a QGIS project (3.22 and later): layers in groups with their styles, and words. The
// XML of its parts; all else is the template's (report/qgis_template_gdal.hpp).
// in:    layers by their paths relative to the project
// out:   XML
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace talus {

struct QgisLayer {
  enum Kind { raster, hillshade, contours, point, line, polygon };
  std::string group, name;  ///< groups are in the order of their first layer, top first
  std::string source;       ///< relative to the project: "maps/reach.tif", "a.gpkg|layername=b"
  Kind kind = raster;
  std::string style;    ///< QML of the layer; not used for a hillshade and contours
  bool visible = true;  ///< when the project is opened
  std::string about{};  ///< definition and unit, for the abstract
  std::string shown{};  ///< name of `style` where there are several
  std::vector<std::pair<std::string, std::string>> other_styles{};  ///< by name, QML
  std::vector<std::pair<std::string, std::string>> fields{};        ///< name and title
};

struct QgisProject {
  /// Of the template's placeholders: "title" -> "a slope: rockslide hazard".
  std::map<std::string, std::string> words;
  std::string remark;               ///< that runs failed: in the abstract of each layer
  std::string run;                  ///< "run id 1f, Talus 1.0": there too
  std::string crs_wkt, crs_authid;  ///< "EPSG:31287"; either may be empty
  std::array<double, 4> extent{};   ///< x_min, y_min, x_max, y_max of the map [m]
  double contour_interval = 0;      ///< of layers of that kind [m]
  std::vector<QgisLayer> layers;    ///< top to bottom
  bool is_edited = false;           ///< layers of it are: new corners snap to those there are
};

/// QGIS evaluates text between [% and %] in labels and legends: foreign words must not be.
[[nodiscard]] std::string without_expressions(std::string words);

/// Each throws nothing; text is escaped.
[[nodiscard]] std::string crs_parts_xml(const QgisProject& project);    ///< in <spatialrefsys>
[[nodiscard]] std::string layer_tree_xml(const QgisProject& project);   ///< in <layer-tree-group>
[[nodiscard]] std::string map_canvas_xml(const QgisProject& project);   ///< the first view
[[nodiscard]] std::string layers_xml(const QgisProject& project);       ///< in <projectlayers>
[[nodiscard]] std::string layer_order_xml(const QgisProject& project);  ///< in <layerorder>

}  // namespace talus
