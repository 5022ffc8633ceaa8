// tools/site/layer_form.hpp
// How QGIS shows a layer of a site.gpkg: its symbol, and a form with the keys of its section.
#pragma once

#include <string>

#include "site/site_layers.hpp"

namespace talus {

/// Style file (QML) with symbol, names, form fields and their allowed values, by the table of keys.
[[nodiscard]] std::string layer_form_qml(const SiteLayer& layer);

/// The keys of `layer.fields`, in that order, from the table of keys.
[[nodiscard]] std::vector<KeyDescription> fields_of(const SiteLayer& layer);

}  // namespace talus
