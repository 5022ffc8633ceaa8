// libcore/site/site_keys.hpp
// The table of keys of the site file, a row each in site_keys.cpp. Within the module: shared by
// site_toml.cpp, which reads site files and the command line, and site_values_toml.cpp, which lists
// keys and the values in effect.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// Range of a number, in the unit of its key; ends are included unless `open`.
struct KeyRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false, open_high = false;
};
/// False for NaN too.
[[nodiscard]] bool contains(const KeyRange& range, double value);
/// "above 0 to below 90", "at least 1", "a finite number".
[[nodiscard]] std::string text_of(const KeyRange& range);

/// One key: the field that it sets, its allowed values (numbers: range; text: choices separated by
/// |; lists: how many entries), its meaning, and the remedy for a mistake.
template <class Section>
struct SiteKey {
  using Field = std::variant<double Section::*, std::int64_t Section::*, bool Section::*,
                             std::string Section::*, std::vector<double> Section::*,
                             std::vector<Vec3> Section::*, std::vector<std::string> Section::*>;
  const char* name;
  Field field;
  const char* help;
  KeyRange range = {};
  const char* choices = "";
  const char* hint = "";
  int n_min = 0, n_max = 1 << 20;  ///< entries of a list
};

/// The rows of one section, in the order in which they are printed.
template <class Section>
const std::vector<SiteKey<Section>>& keys_of();
// clang-format off
template <> const std::vector<SiteKey<SiteInfo>>& keys_of();
template <> const std::vector<SiteKey<TerrainSettings>>& keys_of();
template <> const std::vector<SiteKey<SourceSettings>>& keys_of();
template <> const std::vector<SiteKey<JointNorth>>& keys_of();
template <> const std::vector<SiteKey<JointSettings>>& keys_of();
template <> const std::vector<SiteKey<MaterialSettings>>& keys_of();
template <> const std::vector<SiteKey<GroundSettings>>& keys_of();
template <> const std::vector<SiteKey<SolverSettings>>& keys_of();
template <> const std::vector<SiteKey<FenceSettings>>& keys_of();
template <> const std::vector<SiteKey<DamSettings>>& keys_of();
template <> const std::vector<SiteKey<ForestSettings>>& keys_of();
template <> const std::vector<SiteKey<OutputSettings>>& keys_of();
template <> const std::vector<SiteKey<BaseMotionSettings>>& keys_of();
template <> const std::vector<SiteKey<WaterSettings>>& keys_of();
template <> const std::vector<SiteKey<FragmentationSettings>>& keys_of();
template <> const std::vector<SiteKey<PlacedSettings>>& keys_of();
template <> const std::vector<SiteKey<RockfallSettings>>& keys_of();
template <> const std::vector<SiteKey<UncertaintySettings>>& keys_of();
template <> const std::vector<SiteKey<QuantitySettings>>& keys_of();
template <> const std::vector<SiteKey<PlaceSettings>>& keys_of();
template <> const std::vector<SiteKey<ObservedSettings>>& keys_of();
template <> const std::vector<SiteKey<ObjectSettings>>& keys_of();
template <> const std::vector<SiteKey<FenceSearchSettings>>& keys_of();
template <> const std::vector<SiteKey<HazardSettings>>& keys_of();
template <> const std::vector<SiteKey<HazardClassSettings>>& keys_of();
template <> const std::vector<SiteKey<VariantSettings>>& keys_of();
// clang-format on

/// A field of a section of the site, by its type.
template <class... T>
using PointerTo = std::variant<T*...>;
using Field = PointerTo<double, std::int64_t, bool, std::string, std::vector<double>,
                        std::vector<Vec3>, std::vector<std::string>>;
using ConstField =
    PointerTo<const double, const std::int64_t, const bool, const std::string,
              const std::vector<double>, const std::vector<Vec3>, const std::vector<std::string>>;

/// A key as of SiteKey, with the field that it sets. Code that uses a key is written for all
/// sections at once, and compiled once.
template <class FieldType>
struct KeyOf {
  const char* name;
  FieldType field;
  const char* help;
  KeyRange range;
  const char* choices;
  const char* hint;
  int n_min, n_max;
};
template <class FieldType>
using Keys = std::vector<KeyOf<FieldType>>;

/// The keys of a section, with its fields.
template <class Section>
[[nodiscard]] auto keys_in(Section& section) {
  using FieldType = std::conditional_t<std::is_const_v<Section>, ConstField, Field>;
  Keys<FieldType> keys;
  for (const auto& key : keys_of<std::remove_const_t<Section>>())
    keys.push_back({key.name,
                    std::visit([&](auto field) { return FieldType(&(section.*field)); }, key.field),
                    key.help, key.range, key.choices, key.hint, key.n_min, key.n_max});
  return keys;
}

/// Calls visit(name, section) for the single sections and visit(group, vector) for the named ones,
/// whose group may be a part of a section ("hazard.class").
template <class SiteType, class Visit>
void for_each_group(SiteType& site, Visit&& visit) {
  visit("site", site.info);
  visit("terrain", site.terrain);
  visit("source", site.source);
  visit("joints", site.joint_north);
  visit("joints", site.joints);
  visit("material", site.materials);
  visit("ground", site.grounds);
  visit("blocks", site.blocks);
  visit("rockfall", site.rockfalls);
  visit("solver", site.solver);
  visit("fence", site.fences);
  visit("dam", site.dams);
  visit("forest", site.forests);
  visit("base_motion", site.base_motion);
  visit("water", site.water);
  visit("fragmentation", site.fragmentation);
  visit("output", site.output);
  visit("uncertainty", site.uncertainty);
  visit("uncertainty", site.quantities);
  visit("place", site.places);
  visit("observed", site.observed);
  visit("object", site.objects);
  visit("fence_search", site.fence_searches);
  visit("hazard", site.hazard);
  visit("hazard.class", site.hazard_classes);
  visit("variant", site.variants);
}

/// A section of the site; the name of a single one is empty.
template <class FieldType>
struct SectionOf {
  std::string group, name;
  Keys<FieldType> keys;
};
[[nodiscard]] std::vector<SectionOf<Field>> sections_in(Site& site);
[[nodiscard]] std::vector<SectionOf<ConstField>> sections_in(const Site& site);

/// "joints.J1"; the group alone for a single section.
[[nodiscard]] inline std::string path_of(const std::string& group, const std::string& name) {
  return name.empty() ? group : group + "." + name;
}

}  // namespace talus
