// libcore/site/site_layers.hpp: public
// Layers that define sections of the site file: drawn and edited in a GIS, a feature a place.
// Fields have the names of keys. Page: docs/guide/site-layers.md
#pragma once

#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// One layer of a site.gpkg.
struct SiteLayer {
  enum Shape { areas, lines, points };
  std::string name;     ///< "fences"
  std::string section;  ///< of all of its features ("source"), or the group of theirs ("fence")
  Shape shape = areas;
  std::string prefix;               ///< of the key that names the file: "polygon_"
  std::string title;                ///< for people
  std::vector<std::string> fields;  ///< keys that the layer is made with; more may be added
  /// Attributes of each feature that are not keys: features of a section need not share them.
  std::vector<KeyDescription> attributes = {};
};
[[nodiscard]] const std::vector<SiteLayer>& site_layers();

/// Names of the attributes of each feature of a layer; most layers have none.
[[nodiscard]] std::vector<std::string> attributes_of(const std::string& layer);

/// Whether each feature has a name, which is that of [fence.NAME]; the features of [source] do not.
[[nodiscard]] bool has_names(const SiteLayer& layer);

/// Values of a layer for one section.
struct LayerSection {
  struct Value {
    std::string key, text;  ///< text as in --set; without quotes
  };
  std::string group, name;  ///< "fence", "valley"; name is empty for [source]
  std::string place;        ///< "site.gpkg, layer fences, feature 2": for messages
  std::vector<Value> values;
  std::string digest = {};  ///< of the features
};

/// Takes sections in, behind those of the site file. Throws InputError as read_site(), and for a
/// key that the site file gives too.
void take_sections(Site& site, const std::vector<LayerSection>& sections);

/// Takes the [uncertainty.NAME] of a text in place of those of the site. Throws InputError as
/// parse_site(), for a text without any, and for one with anything else.
void take_quantities(Site& site, const std::string& text, const std::string& path);

}  // namespace talus
