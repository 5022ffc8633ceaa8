// libcore/setup/site_layers_gdal.hpp: public
// The layers of a site.gpkg that define sections of the site file. Page: docs/guide/site-layers.md
#pragma once

#include "base/input_log.hpp"
#include "site/site.hpp"

namespace talus {

/// Takes in the values of the GeoPackage of [site] layers; nothing where the site file names none.
/// Its features count for the run's id, its bytes do not: a GIS changes these when it looks at it.
/// Throws InputError: no such file, none of the layers, a feature without a name or with one that
/// is none, a misspelt field, features of one name that disagree, and as take_sections().
void read_site_layers(InputLog& log, Site& site);

}  // namespace talus
