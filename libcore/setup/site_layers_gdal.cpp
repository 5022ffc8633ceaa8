// Reads the layers of a site.gpkg that define sections of the site file.
#include "setup/site_layers_gdal.hpp"

#include <algorithm>
#include <filesystem>

#include "base/file_paths.hpp"
#include "base/text.hpp"
#include "import/feature_tables_gdal.hpp"
#include "site/site_layers.hpp"

namespace talus {
namespace {

constexpr const char* name_field = "name";

std::vector<std::string> keys_of(const SiteLayer& layer) {
  const std::string section = has_names(layer) ? layer.section + ".NAME" : layer.section;
  std::vector<std::string> keys;
  for (const KeyDescription& row : site_keys())
    if (row.section == section) keys.push_back(row.key);
  return keys;
}

// A field may be anybody's own; one that is nearly a key is a mistake.
void check_field(const std::string& field, std::vector<std::string> keys,
                 const std::vector<std::string>& attributes, const std::string& place) {
  keys.insert(keys.end(), attributes.begin(), attributes.end());
  if (const std::string nearest = nearest_name(field, keys); !nearest.empty())
    throw InputError({place}, "has a field " + field + " that is not a key",
                     "did you mean " + nearest + "? Rename the field, or empty it");
}

// A file may hold layers of its own, which are named; one that is nearly that of a section is a
// mistake. Case does not count, as in the file itself.
void check_layers(InputLog& log, const std::string& path, const std::vector<std::string>& known) {
  std::string others;
  for (const std::string& layer : layers_of(path)) {
    const std::string name = lower(layer);
    if (name == "layer_styles" || std::count(known.begin(), known.end(), name) > 0)
      continue;  // QGIS keeps its styles in a table of that name
    if (const std::string nearest = nearest_name(name, known); !nearest.empty())
      throw InputError({path}, "has a layer " + layer + " that stands for no section",
                       "did you mean " + nearest + "? Rename the layer, or take it out");
    others += (others.empty() ? "" : ", ") + layer;
  }
  if (!others.empty()) log.info(path + ": layers that stand for no section: " + others);
}

std::string name_of(const FeatureTable& table, const FeatureTable::Row& row,
                    const std::string& place) {
  const auto at = std::find(table.fields.begin(), table.fields.end(), name_field);
  const std::string name = at == table.fields.end()
                               ? ""
                               : row.values[static_cast<std::size_t>(at - table.fields.begin())];
  const bool is_plain = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) > ' ' &&
           std::string(".'\"\\").find(c) == std::string::npos;
  });
  if (!is_plain)
    throw InputError({place}, name.empty() ? "has no name" : "has the name \"" + name + "\"",
                     "its field `name` must hold a name without blanks, dots, quotes and \\");
  return name;
}

struct Reader {
  const Site& site;
  const SiteLayer& layer;
  const FeatureTable& table;
  std::vector<std::string> keys = keys_of(layer), attributes = attributes_of(layer.name);
  std::vector<LayerSection> sections = {};

  std::string place_of(const FeatureTable::Row& row) const {
    return site.info.layers + ", layer " + table.layer + ", feature " + std::to_string(row.id);
  }

  LayerSection& section_named(const std::string& name, const std::string& place) {
    for (LayerSection& section : sections)
      if (section.name == name) return section;
    LayerSection section{layer.section, name, place, {}};
    const std::string filter = name.empty() ? "" : "name = '" + name + "'";
    section.digest =
        digest_of_features(resolved(site, site.info.layers), layer.name, filter, attributes);
    section.values.push_back({layer.prefix + "file", site.info.layers + "|layername=" + layer.name +
                                                         (filter.empty() ? "" : "|subset=") +
                                                         filter});
    sections.push_back(std::move(section));
    return sections.back();
  }

  // Several features of a section may leave a value to one another, but not contradict.
  static void take(LayerSection& section, const std::string& key, const std::string& value,
                   const std::string& place) {
    for (const LayerSection::Value& known : section.values) {
      if (known.key != key) continue;
      if (known.text == value) return;
      throw InputError({place},
                       key + " is " + value + ", that of " + section.place + " is " + known.text,
                       "features of one section share its values: make them alike, or empty one");
    }
    section.values.push_back({key, value});
  }

  void read(const FeatureTable::Row& row) {
    const std::string place = place_of(row);
    LayerSection& section =
        section_named(has_names(layer) ? name_of(table, row, place) : "", place);
    for (std::size_t i = 0; i < table.fields.size(); ++i) {
      const std::string& field = table.fields[i];
      if (row.values[i].empty() || field == name_field) continue;
      if (std::count(attributes.begin(), attributes.end(), field) > 0) continue;
      if (std::count(keys.begin(), keys.end(), field) == 0)
        check_field(field, keys, attributes, place);
      else
        take(section, field, row.values[i], place);
    }
  }
};

}  // namespace

void read_site_layers(InputLog& log, Site& site) {
  if (site.info.layers.empty()) return;
  const std::string path = resolved(site, site.info.layers);
  const Where where = where_of(site, "site.layers");
  if (!std::filesystem::exists(file_of(path)))
    throw InputError(where, "layers of [site]: there is no file " + path,
                     "names are relative to the folder of the site file; talus-site --new-layers "
                     "makes an empty one");
  log.read_by_content(path);
  std::vector<std::string> names;
  for (const SiteLayer& layer : site_layers()) names.push_back(layer.name);
  check_layers(log, path, names);
  const std::vector<FeatureTable> tables = read_feature_tables(path, names);
  if (tables.empty())
    throw InputError(where, path + " has none of the layers that stand for sections",
                     "they are called source, fences, grounds ...: docs/guide/site-layers.md");
  std::vector<LayerSection> sections;
  for (const FeatureTable& table : tables) {
    const auto layer = std::find_if(site_layers().begin(), site_layers().end(),
                                    [&](const SiteLayer& l) { return l.name == table.layer; });
    if (layer == site_layers().end()) continue;
    Reader reader{site, *layer, table};
    for (const FeatureTable::Row& row : table.rows) reader.read(row);
    sections.insert(sections.end(), reader.sections.begin(), reader.sections.end());
  }
  take_sections(site, sections);
  site.layers_file = site.info.layers;
  site.info.layers.clear();
}

}  // namespace talus
