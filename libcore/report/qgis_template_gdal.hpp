// libcore/report/qgis_template_gdal.hpp: public
// A QGIS project from a template that QGIS saved: an office draws its own title block and layout
// there. Placeholders: docs/tools/talus-report.md
// in:    the template, a site's layers and words
// out:   the XML of a .qgs
#pragma once

#include <string>

#include "report/qgis_project.hpp"

namespace talus {

struct QgisTemplate {
  std::string path;  ///< for messages
  std::string xml;   ///< of a .qgs
};

/// Of a .qgs, or of the one in a .qgz. Throws InputError when there is none.
[[nodiscard]] QgisTemplate read_qgis_template(const std::string& path);

/// The template with the site's words, CRS, extent and layers; its own layers stay, below those of
/// the site or around the group {layers}. Every map item of its layouts shows the site's extent,
/// grids and scale bars get round steps. Words are never evaluated as expressions of QGIS. Throws
/// InputError for a text that is not a project or lacks a layout or a map item, and for an unknown
/// {name}.
[[nodiscard]] std::string qgis_project_xml(const QgisProject& project, const QgisTemplate& from);

}  // namespace talus
