// The part of site/site.hpp that reads a site file: every key by its row of site_keys.cpp.
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/printable.hpp"
#include "base/read_file.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "site/gone_keys.hpp"
#include "site/site_keys.hpp"
#include "site/site_layers.hpp"
#include "site/soils.hpp"
#include "site/stages.hpp"
#include "site/uncertainty.hpp"

namespace talus {
namespace {

using Texts = std::vector<std::string>;
using Points = std::vector<Vec3>;
using Numbers = std::vector<double>;

// --- values ------------------------------------------------------------------------------------

const char* type_name(toml::node_type type) {
  switch (type) {
    case toml::node_type::string:
      return "text";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a section";
    default:
      return "a date or time";
  }
}

// Parts of the longest dotted key ("a.b.c": 3), as far as the text has any: the parser, and the
// code that frees its tables, go as deep. Text between quotes is a part of its own.
int longest_dotted_key(const std::string& text, int& line) {
  int longest = 0, parts = 1, here = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.') {
      if (++parts > longest) longest = parts, line = here;
    } else if (c == '"' || c == '\'') {
      const std::size_t end = text.find_first_of(std::string{c, '\n'}, i + 1);
      if (end != std::string::npos && text[end] == c) i = end;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (std::string_view("=[]{},\n").find(c) != std::string_view::npos) {
      parts = 1;
      here += c == '\n';
    }
  }
  return longest;
}

// Throws InputError besides the errors of the parser.
toml::table parsed(const std::string& text, const std::string& path) {
  constexpr int deepest = 1000;
  int line = 0;
  if (const int n = longest_dotted_key(text, line); n > deepest)
    throw InputError({path, line}, "a key of " + std::to_string(n) + " parts, expected one or two",
                     "a key is SECTION.NAME or NAME");
  return toml::parse(text, path);
}

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

// A value being read: its place and its name in messages.
struct Place {
  Where where;
  std::string key;
  const char* hint;
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InputError(where, key + " is " + found + ", expected " + expected, hint);
  }
};

double number_of(const toml::node& node, const KeyRange& range, const Place& place) {
  double value = 0;
  if (const auto* real = node.as_floating_point())
    value = real->get();
  else if (const auto* whole = node.as_integer())
    value = static_cast<double>(whole->get());
  else
    place.refuse(type_name(node.type()), "a number");
  if (!contains(range, value)) place.refuse(text(value), text_of(range));
  return value;
}

std::int64_t whole_number_of(const toml::node& node, const KeyRange& range, const Place& place) {
  const auto* whole = node.as_integer();
  if (!whole) place.refuse(type_name(node.type()), "a whole number");
  if (!contains(range, static_cast<double>(whole->get())))
    place.refuse(std::to_string(whole->get()), text_of(range));
  return whole->get();
}

const toml::array& list_of(const toml::node& node, const Place& place, int n_min, int n_max) {
  const auto* list = node.as_array();
  if (!list) place.refuse(type_name(node.type()), "a list");
  const int n = static_cast<int>(std::min<size_t>(list->size(), 1u << 30));
  if (n < n_min || n > n_max)
    place.refuse("a list of " + std::to_string(n),
                 n_min == n_max ? std::to_string(n_min) + " entries"
                 : n < n_min    ? "at least " + std::to_string(n_min) + " entries"
                                : "at most " + std::to_string(n_max) + " entries");
  return *list;
}

// [x, y] or [x, y, z]; z is NaN when not given.
Vec3 point_of(const toml::node& node, const Place& place) {
  const toml::array& list = list_of(node, place, 2, 3);
  Vec3 point(0, 0, not_given);
  for (size_t k = 0; k < list.size(); ++k)
    point[static_cast<Eigen::Index>(k)] = number_of(list[k], KeyRange{}, place);
  return point;
}

struct Reader {
  const KeyOf<Field>& key;
  const toml::node& node;
  const Place& place;

  void operator()(double* field) const { *field = number_of(node, key.range, place); }
  void operator()(std::int64_t* field) const { *field = whole_number_of(node, key.range, place); }
  void operator()(bool* field) const {
    const auto* flag = node.as_boolean();
    if (!flag) place.refuse(type_name(node.type()), "true or false");
    *field = flag->get();
  }
  void operator()(std::string* field) const {
    const auto* value = node.as_string();
    if (!value) place.refuse(type_name(node.type()), "text");
    const std::string choices = std::string("|") + key.choices + "|";
    const bool is_plain = value->get().find_first_of(std::string("|\0", 2)) == std::string::npos;
    if (*key.choices && (!is_plain || choices.find("|" + value->get() + "|") == std::string::npos))
      place.refuse("\"" + value->get() + "\"", "one of " + std::string(key.choices));
    *field = value->get();
  }
  void operator()(Numbers* field) const {
    field->clear();
    for (const toml::node& entry : list_of(node, place, key.n_min, key.n_max))
      field->push_back(number_of(entry, key.range, place));
  }
  // One text may be given without the list.
  void operator()(Texts* field) const {
    field->clear();
    const auto add = [&](const toml::node& entry) {
      const auto* value = entry.as_string();
      if (!value) place.refuse(type_name(entry.type()), "text");
      field->push_back(value->get());
    };
    if (node.is_string()) return add(node);
    for (const toml::node& entry : list_of(node, place, key.n_min, key.n_max)) add(entry);
  }
  // One point may be given without the outer list.
  void operator()(Points* field) const {
    field->clear();
    const toml::array& list = list_of(node, place, 1, key.n_max);
    if (!list[0].is_array() && key.n_min <= 1) {
      field->push_back(point_of(node, place));
      return;
    }
    for (const toml::node& entry : list_of(node, place, key.n_min, key.n_max))
      field->push_back(point_of(entry, place));
  }
};

// --- sections ----------------------------------------------------------------------------------

Texts key_names(const auto& keys) {
  Texts names;
  for (const auto& key : keys) names.emplace_back(key.name);
  return names;
}

// "depth" for depth_m: the entries that begin with the name, as units are often omitted.
std::string without_its_unit(std::string_view name, const Texts& known) {
  std::string words;
  for (const std::string& entry : known)
    if (entry.size() > name.size() && entry.starts_with(name) && entry[name.size()] == '_')
      words += (words.empty() ? "" : " or ") + entry;
  return words;
}

std::string did_you_mean(std::string_view name, const Texts& known) {
  if (name.starts_with("strike"))
    for (const std::string& entry : known)
      if (entry.ends_with("dip_direction_deg"))
        return entry +
               " is the azimuth of the steepest way down: strike + 90 by the right-hand "
               "rule, strike - 90 by the left-hand rule";
  const std::string longer = without_its_unit(name, known);
  if (!longer.empty()) return "did you mean " + longer + "?";
  const std::string nearest = nearest_name(name, known);
  if (!nearest.empty()) return "did you mean " + nearest + "?";
  std::string all;
  for (const std::string& entry : known) all += (all.empty() ? "known: " : ", ") + entry;
  return all;
}

const toml::table& table_of(const toml::node& node, const Where& where, const std::string& name) {
  const auto* table = node.as_table();
  if (!table)
    throw InputError(where, name + " is " + type_name(node.type()) + ", expected a section",
                     "write [" + name + "] on a line of its own");
  return *table;
}

void read_value(const KeyOf<Field>& key, const std::string& path, const toml::node& node,
                const Where& where) {
  std::visit(Reader{key, node, Place{where, path, key.hint}}, key.field);
}

// The row of `name`, or an InputError that names the nearest.
const KeyOf<Field>& key_named(const Keys<Field>& keys, std::string_view name,
                              const std::string& section, const Where& where) {
  for (const auto& key : keys)
    if (name == key.name) return key;
  if (const std::string instead = written_instead(section, name); !instead.empty())
    throw InputError(where, "the key " + std::string(name) + " of [" + section + "] is gone",
                     "write " + instead);
  throw InputError(where, "unknown key " + std::string(name) + " in [" + section + "]",
                   did_you_mean(name, key_names(keys)));
}

// [joints] and [uncertainty] hold keys of their own beside the sections [joints.NAME] and so on.
bool stands_beside_named(const std::string& section) {
  return section == "joints" || section == "uncertainty";
}

// [hazard] holds the named sections [hazard.class.NAME].
bool is_group_within(const std::string& section, std::string_view key) {
  return section == "hazard" && key == "class";
}

bool has_key(const auto& keys, std::string_view name) {
  return std::any_of(keys.begin(), keys.end(), [&](const auto& key) { return name == key.name; });
}

void read_section(Site& site, const Keys<Field>& keys, const std::string& name,
                  const toml::table& table) {
  for (const auto& [key_text, node] : table) {
    if (stands_beside_named(name) && !has_key(keys, key_text.str())) continue;
    if (is_group_within(name, key_text.str())) continue;
    if (name.starts_with("variant.") && node.is_table()) continue;
    const Where where{site.file, line_of(node)};
    const auto& key = key_named(keys, key_text.str(), name, where);
    read_value(key, std::string(key_text.str()), node, where);
    site.sources[name + "." + key.name] = {ValueSource::from_file, where.line};
  }
}

int& line_field(auto& section) {
  if constexpr (requires { section.line_number; })
    return section.line_number;
  else
    return section.line;
}

// Keys of a group beside its named sections; none in most groups.
Texts keys_beside(const std::string& group) {
  if (group == "joints") return key_names(keys_of<JointNorth>());
  if (group == "uncertainty") return key_names(keys_of<UncertaintySettings>());
  return {};
}

// A value where a named section is expected.
[[noreturn]] void refuse_value(const std::string& file, const std::string& group,
                               const std::string& name, const toml::node& node,
                               const Texts& beside) {
  const Where where{file, line_of(node)};
  const std::string nearest = nearest_name(name, beside);
  throw InputError(
      where,
      group + "." + name + " is " + type_name(node.type()) + ", expected a section of its own",
      nearest.empty() ? "[" + group + "] holds named sections: write [" + group + ".NAME]"
                      : "did you mean " + nearest + "? A section is written [" + group + ".NAME]");
}

// A name is used in messages, tables, pages and commands.
void check_name(const std::string& group, const std::string& name, const Where& where) {
  const bool is_seen = printable(name) == name && name.find_first_of("\n\t") == std::string::npos;
  if (is_seen && !name.empty()) return;
  throw InputError(where,
                   "the name " + name + " of a section [" + group +
                       ".*] is empty, or holds control characters or others that are not seen",
                   "use letters of any alphabet, digits, blanks and signs");
}

// --- variants: their changes ------

struct Group {
  std::string name;  // "fence", "hazard.class"
  bool is_named;
};
const std::vector<Group>& all_groups() {
  static const std::vector<Group> groups = [] {
    std::vector<Group> list;
    Site site;
    for_each_group(site, [&list]<class Of>(const char* name, Of& sections) {
      list.push_back({name, requires { sections.front(); }});
});
return list;
}
();
return groups;
}

Texts group_names() {
  Texts names;
  for (const Group& group : all_groups()) names.push_back(group.name);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string joined(const Texts& parts, std::size_t n) {
  std::string out;
  for (std::size_t i = 0; i < n; ++i) out += (i == 0 ? "" : ".") + parts[i];
  return out;
}

// `path`: the group, the name where it has names, and the key.
VariantSettings::Change change_of(const Texts& path, const toml::node& node,
                                  const VariantSettings& variant, const std::string& file) {
  std::ostringstream value;
  value << toml::node_view<const toml::node>(node);
  const std::size_t n = path.size() - 1;
  for (const auto& [group, is_named] : all_groups()) {
    const std::size_t parts = n - (is_named ? 1 : 0);
    if (parts > 0 && group != "variant" && joined(path, parts) == group)
      return {group, is_named ? path[n - 1] : "", path[n], value.str(), line_of(node)};
  }
  const bool has_no_name = joined(path, n) == "hazard.class" ||
                           (n == 1 && std::any_of(all_groups().begin(), all_groups().end(),
                                                  [&](auto& g) { return g.name == path[0]; }));
  throw InputError({file, line_of(node)},
                   "unknown section " + joined(path, n) + " in [variant." + variant.name + "]",
                   has_no_name ? "it has sections of a name: write [variant." + variant.name + "." +
                                     joined(path, n) + ".NAME]"
                               : did_you_mean(path[0], group_names()));
}

void read_changes(VariantSettings& variant, const Texts& path, const toml::table& table,
                  const std::string& file) {
  for (const auto& [key, node] : table) {
    Texts at = path;
    at.emplace_back(key.str());
    if (const auto* inner = node.as_table())
      read_changes(variant, at, *inner, file);
    else if (!path.empty())
      variant.changes.push_back(change_of(at, node, variant, file));
  }
  std::stable_sort(variant.changes.begin(), variant.changes.end(),
                   [](const auto& a, const auto& b) { return a.line < b.line; });
}

// [group.NAME] sections, in the order of the file (tables are kept sorted by name).
template <class Section>
void read_named(Site& site, std::vector<Section>& sections, const std::string& group,
                const toml::table& tables) {
  std::vector<std::pair<const toml::node*, std::string>> found;
  const Texts beside = keys_beside(group);
  for (const auto& [name, node] : tables)
    if (std::find(beside.begin(), beside.end(), name.str()) == beside.end())
      found.emplace_back(&node, std::string(name.str()));
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return line_of(*a.first) < line_of(*b.first);
  });
  for (const auto& [node, name] : found) {
    const Where where{site.file, line_of(*node)};
    const auto* table = node->as_table();
    if (!table) refuse_value(site.file, group, name, *node, beside);
    check_name(group, name, where);
    Section section;
    section.name = name;
    line_field(section) = where.line;
    read_section(site, keys_in(section), group + "." + name, *table);
    if constexpr (std::is_same_v<Section, VariantSettings>)
      read_changes(section, {}, *table, site.file);
    sections.push_back(std::move(section));
  }
}

struct GroupReader {
  Site& site;
  const toml::table& root;
  template <class Section>
  void operator()(const char* name, Section& section) const {
    if (const toml::node* node = root.get(name)) {
      if (!stands_beside_named(name)) site.sections.emplace_back(name);
      read_section(site, keys_in(section), name,
                   table_of(*node, {site.file, line_of(*node)}, name));
    }
  }
  template <class Section>
  void operator()(const char* name, std::vector<Section>& sections) const {
    const toml::node_view<const toml::node> found = root.at_path(name);
    if (const toml::node* node = found.node()) {
      site.sections.emplace_back(name);
      read_named(site, sections, name, table_of(*node, {site.file, line_of(*node)}, name));
    }
  }
};

void check_groups(const toml::table& root, const std::string& file) {
  const Texts known = group_names();
  for (const auto& [name, node] : root) {
    if (std::find(known.begin(), known.end(), name.str()) != known.end()) continue;
    const std::string kind = node.is_table() ? "section " : "key outside any section: ";
    throw InputError({file, line_of(node)}, "unknown " + kind + std::string(name.str()),
                     did_you_mean(name.str(), known));
  }
}

void fill_defaults(Site& site) {
  namespace fs = std::filesystem;
  site.folder = fs::path(site.file).parent_path().string();
  if (site.info.name.empty()) {
    std::error_code unreadable;
    const fs::path whole = fs::absolute(site.file, unreadable);
    site.info.name = unreadable ? "site" : whole.parent_path().filename().string();
  }
  if (site.materials.empty()) {
    site.materials.emplace_back();
    site.materials.back().name = "rock";
  }
  if (site.grounds.empty()) {
    site.grounds.emplace_back();
    site.grounds.back().name = "ground";
  }
  if (site.rockfalls.empty()) return;
  // Each run draws rocks of its own, so that several give intervals; a rock that leaves the terrain
  // is counted.
  const auto unless_given = [&site](const char* key, auto& value, auto otherwise) {
    if (site.sources.count(key) == 0) value = otherwise;
  };
  unless_given("uncertainty.rock_masses", site.uncertainty.rock_masses, 1000000);
  unless_given("solver.n_runs", site.solver.n_runs, 10);
  unless_given("solver.max_lost_share", site.solver.max_lost_share, 1.0);
}

// Names that other sections refer to.
void check_material(const Site& site, const std::string& material, const std::string& key) {
  Texts known;
  for (const auto& entry : site.materials) known.push_back(entry.name);
  if (material.empty()) {
    if (known.size() == 1) return;
    throw InputError(where_of(site, key), key + " is not given, but there are several materials",
                     "name one of [material.*]");
  }
  if (std::find(known.begin(), known.end(), material) == known.end())
    throw InputError(where_of(site, key), key + " is \"" + material + "\", which is not a material",
                     did_you_mean(material, known));
}

void check_names(const Site& site) {
  const auto stands = [&](const char* section) {
    return std::find(site.sections.begin(), site.sections.end(), section) != site.sections.end();
  };
  if (stands("source")) check_material(site, site.source.material, "source.material");
  for (const auto& body : site.blocks)
    check_material(site, body.material, "blocks." + body.name + ".material");
  for (const auto& body : site.rockfalls)
    check_material(site, body.material, "rockfall." + body.name + ".material");
  if (site.rockfalls.empty()) return;
  const RockfallSettings& first = site.rockfalls.front();
  const Where where{site.file, first.line, "rockfall." + first.name};
  if (!moves_alone(site))
    throw InputError(where, "rocks of [rockfall.*] fall one by one, and solver.blocks is together",
                     "bodies that stand together are [blocks.*]");
  const bool is_cut = !site.source.polygon.empty() || !site.source.polygon_file.empty();
  if (is_cut || !site.blocks.empty())
    throw InputError(where,
                     std::string("rocks fall one by one, and ") +
                         (is_cut ? "[source] is cut into blocks" : "[blocks.*] are bodies") +
                         " that move together",
                     "make two sites of it");
}

// --- command line ------------------------------------------------------------------------------

// `value` as a list of one TOML value; plain text when it is none. In a list a remark ("5 # m") is
// no value either.
toml::array parsed_value(const std::string& value) {
  try {
    toml::table table = parsed("value = [" + value + "]", "--set");
    if (auto* list = table["value"].as_array(); table.size() == 1 && list && list->size() == 1)
      return std::move(*list);
  } catch (const toml::parse_error&) {
    // not a TOML value: text without quotes
  }
  return toml::array{value};
}

// As parsed_value(); a value without quotes of a key that takes text is text, also 2024 or true.
toml::array value_for(const KeyOf<Field>& key, const std::string& value) {
  toml::array parsed = parsed_value(value);
  const bool takes_text = std::holds_alternative<std::string*>(key.field);
  return takes_text && !parsed[0].is_string() ? toml::array{value} : std::move(parsed);
}

// --- layers ------------------------------------------------------------------------------------

// Databases lack lists and often truth values: they hold TOML as text unless the key is a text.
toml::array layer_value(const Field& field, const std::string& words) {
  if (std::holds_alternative<std::string*>(field)) return toml::array{words};
  const bool is_truth = std::holds_alternative<bool*>(field);
  return parsed_value(is_truth && words == "1"   ? "true"
                      : is_truth && words == "0" ? "false"
                                                 : words);
}

// Calls take(keys) for a section; a named one is added where it is missing.
struct SectionFinder {
  const std::string &group, &name;
  const std::function<void(const Keys<Field>&)>& take;

  template <class Section>
  void operator()(const char* of, Section& fields) const {
    if (name.empty() && group == of) take(keys_in(fields));
  }
  template <class Section>
  void operator()(const char* of, std::vector<Section>& sections) const {
    if (name.empty() || group != of) return;
    const auto is_it = [this](const Section& section) { return section.name == name; };
    auto at = std::find_if(sections.begin(), sections.end(), is_it);
    if (at == sections.end()) {
      at = sections.emplace(sections.end());
      at->name = name;
    }
    take(keys_in(*at));
  }
};

void note_section(Site& site, const std::string& group) {
  if (std::find(site.sections.begin(), site.sections.end(), group) == site.sections.end())
    site.sections.push_back(group);
}

bool has_name(const Texts& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// As if it had not been given; of lists and text.
void clear(const Field& field) {
  std::visit(
      [](auto* value) {
        if constexpr (requires { value->clear(); }) value->clear();
      },
      field);
}

struct SectionTaker {
  Site& site;
  const LayerSection& from;

  void take_value(const Keys<Field>& keys, const std::string& path,
                  const LayerSection::Value& value) const {
    const Where where{from.place};
    const KeyOf<Field>& row = key_named(keys, value.key, path, where);
    const auto given = site.sources.find(path + "." + row.name);
    if (given != site.sources.end() && given->second.kind != ValueSource::from_soil)
      throw InputError(where,
                       std::string(row.name) + " of [" + path + "] stands here and in " +
                           (given->second.kind == ValueSource::from_layer
                                ? given->second.words
                                : site.file + ":" + std::to_string(given->second.line)),
                       "say it once: take it out of one of the two");
    const toml::array holder = layer_value(row.field, value.text);
    read_value(row, path + "." + row.name, holder[0], where);
    site.sources[path + "." + row.name] = {ValueSource::from_layer, 0, from.place};
  }
};

// Remedy for a file that is not TOML.
std::string way_to_toml(const std::string& finding, const std::string& text,
                        const std::string& path) {
  const auto says = [&finding](const char* words) {
    return finding.find(words) != std::string::npos;
  };
  const bool has_mark = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  if (has_mark || says("utf-8") || text.find('\0') != std::string::npos) {
    const char* const code = has_mark                               ? "UTF-16"
                             : text.find('\0') == std::string::npos ? "WINDOWS-1252"
                             : text.starts_with('\0')               ? "UTF-16BE"
                                                                    : "UTF-16LE";
    return std::string("save it as UTF-8: iconv -f ") + code + " -t UTF-8 " + shell_word(path) +
           " > utf8.toml";
  }
  if (says("redefine")) return "a section or key is in the file twice: put its keys in one place";
  if (says("escape") || says("unicode scalar"))
    return "a backslash begins a special sign: write / in paths, or put the text in single quotes";
  return "the file must be TOML: key = value, text in quotes, decimals with a point";
}

}  // namespace

Site parse_site(const std::string& text, const std::string& path) {
  Site site;
  site.file = path;
  toml::table root;
  try {
    root = parsed(text, path);
  } catch (const toml::parse_error& error) {
    const std::string finding(error.description());
    throw InputError({path, static_cast<int>(error.source().begin.line)}, finding,
                     way_to_toml(finding, text, path));
  }
  check_groups(root, path);
  for_each_group(site, GroupReader{site, root});
  fill_defaults(site);
  fill_from_soils(site);
  check_names(site);
  return site;
}

Site read_site(const std::string& path) {
  return parse_site(read_file(path, "give the path of a site.toml"), path);
}

std::size_t end_of_key(const Site& site, const std::string& words) {
  for (std::size_t at = words.find('='); at != std::string::npos; at = words.find('=', at + 1)) {
    const std::size_t last = words.rfind('.', at);
    if (last == std::string::npos) continue;
    bool is_found = false;
    for (const auto& [group, name, keys] : sections_in(site))
      is_found |= path_of(group, name) == words.substr(0, last) &&
                  has_key(keys, words.substr(last + 1, at - last - 1));
    if (is_found) return at;
  }
  return words.find('=');
}

void override_value(Site& site, const std::string& key, const std::string& value) {
  const size_t first = key.find('.'), last = key.rfind('.');
  if (first == std::string::npos)
    throw InputError({"", 0, "command line"}, "\"" + key + "\" is not section.key",
                     "e.g. solver.duration_s");
  const std::string group = key.substr(0, first), section = key.substr(0, last),
                    word = key.substr(last + 1);
  Texts known;
  bool is_done = false;
  for (const auto& [candidate, name, keys] : sections_in(site)) {
    if (!name.empty() && candidate == group) known.push_back(path_of(group, name));
    if (path_of(candidate, name) != section) continue;
    const Where where{"", 0, "command line"};
    const auto& row = key_named(keys, word, section, where);
    read_value(row, section + "." + word, value_for(row, value)[0], where);
    site.sources[section + "." + word] = {ValueSource::from_cli, 0};
    is_done = true;
  }
  if (!is_done)
    throw InputError(
        {"", 0, "command line"}, "no section [" + section + "]",
        known.empty() ? did_you_mean(group, group_names()) : did_you_mean(section, known));
  fill_from_soils(site);
  check_names(site);
}

// --- variants ----------------------------------------------------------------------------------

namespace {

// Keys that replace one another, such as those of a place: the one that a variant gives counts.
const std::vector<Texts>& instead_of_one_another() {
  static const std::vector<Texts> families = {
      {"line", "polygon", "position_m", "file"}, {"polygon", "polygon_file"}, {"contours", "dem"}};
  return families;
}

// Names of the sections of a group.
Texts names_in(const Site& site, const std::string& group) {
  Texts names;
  for (const auto& [of, name, keys] : sections_in(site))
    if (of == group && !name.empty()) names.push_back(name);
  return names;
}

// Why runs of the site and of the variant would not be comparable, and the remedy; empty: they are.
struct Refusal {
  std::string why, hint;
};
constexpr const char* rocks_of_several_volumes =
    "give rocks of each volume a [rockfall.NAME] of their own with its frequency_per_a, and no "
    "frequency to their class; else make another site of it";
bool is_size_of_rocks(const VariantSettings::Change& change) {
  return change.group == "rockfall" &&
         (change.key.starts_with("volume") || change.key.ends_with("_raster") ||
          change.key == "size_m" || change.key == "shape");
}

Refusal refusal_of_measure(const VariantSettings::Change& change) {
  if (change.group == "output" ||
      (change.group == "terrain" && has_name({"cell_size_m", "window_m"}, change.key)))
    return {"would record what cannot be laid over the site's",
            "write it in [" + change.group + "], for all variants"};
  const bool is_strength = has_name({"friction_deg", "cohesion_pa", "tension_pa"}, change.key);
  const bool is_frequency = change.key.starts_with("frequency_");
  if (has_name({"source", "blocks", "uncertainty"}, change.group) ||
      (change.group == "joints" && !is_strength) || (change.group == "rockfall" && !is_frequency))
    return {"would draw other rocks, and the difference would be theirs",
            is_size_of_rocks(change)
                ? std::string(rocks_of_several_volumes)
                : "a mass that is scaled off is named by the key without; else make another site "
                  "of it"};
  return {};
}

Refusal refusal_of_alternative(const VariantSettings::Change& change) {
  const EffectiveValue value{path_of(change.group, change.name), change.key, "", ""};
  const bool is_shared = stage_reads("import", value) || stage_reads("trn", value) ||
                         is_rock_key(value.section + "." + value.key);
  if (stage_reads("run", value) && !is_shared && change.group != "uncertainty") return {};
  const bool would_be_compared = refusal_of_measure(change).why.empty();
  return {"changes nothing in its runs: alternatives share terrain, blocks and what is evaluated",
          would_be_compared
              ? "take the weight out, so that it is compared, or make another site of it"
          : is_size_of_rocks(change) ? rocks_of_several_volumes
                                     : "make another site of it"};
}

Refusal refusal_of(const VariantSettings& variant, const VariantSettings::Change& change) {
  if (change.group == "site") return {"is of the site itself", "write it in [site]"};
  if (change.key == "n_runs" || (change.group == "solver" && change.key == "seed"))
    return {"would make other runs, and runs of the same seeds are compared",
            "write it in [solver], for all variants"};
  return is_alternative(variant) ? refusal_of_alternative(change) : refusal_of_measure(change);
}

void check_change(const Site& site, const VariantSettings& variant,
                  const VariantSettings::Change& change) {
  const Refusal refusal = refusal_of(variant, change);
  if (!refusal.why.empty())
    throw InputError({site.file, change.line},
                     path_of(change.group, change.name) + "." + change.key + " in [variant." +
                         variant.name + "] " + refusal.why,
                     refusal.hint);
}

void take_out(Site& site, const VariantSettings& variant, const std::string& path) {
  const Where where = where_of(site, "variant." + variant.name + ".without");
  Texts known;
  bool is_done = false;
  for_each_group(site, [&]<class Of>(const std::string& group, Of& sections) {
    if constexpr (requires { sections.front(); }) {
      if (group == "variant" || group == "material" || group == "uncertainty") return;
      for (const auto& section : sections) known.push_back(path_of(group, section.name));
      is_done |= std::erase_if(sections, [&](const auto& section) {
                   return path_of(group, section.name) == path;
                 }) > 0;
    }
  });
  if (!is_done)
    throw InputError(
        where,
        "[variant." + variant.name + "] is without " + path + ", and the site has no such section",
        did_you_mean(path, known));
  std::erase_if(site.sources, [&](const auto& of) { return of.first.starts_with(path + "."); });
  site.layer_digests.erase(path);
}

void take_change(Site& site, const VariantSettings& variant,
                 const VariantSettings::Change& change) {
  check_change(site, variant, change);
  const Where where{site.file, change.line};
  const std::string path = path_of(change.group, change.name);
  if (!change.name.empty()) check_name(change.group, change.name, where);
  const std::string words = "variant " + variant.name + ", line ";
  for_each_group(
      site,
      SectionFinder{change.group, change.name, [&](const Keys<Field>& keys) {
                      const KeyOf<Field>& row = key_named(keys, change.key, path, where);
                      read_value(row, path + "." + row.name, parsed_value(change.value)[0], where);
                      site.sources[path + "." + row.name] = {ValueSource::from_variant, change.line,
                                                             words + std::to_string(change.line)};
                      for (const Texts& family : instead_of_one_another()) {
                        if (!has_name(family, row.name)) continue;
                        for (const KeyOf<Field>& other : keys) {
                          const auto at = site.sources.find(path + "." + other.name);
                          if (!has_name(family, other.name) || at == site.sources.end() ||
                              at->second.words.starts_with(words))
                            continue;
                          clear(other.field);
                          site.sources.erase(at);
                        }
                      }
                    }});
  note_section(site, change.group);
}

// A fence that the variant adds, or whose name is mistyped.
void check_new_section(const Site& site, const VariantSettings& variant,
                       const VariantSettings::Change& change, const Texts& known) {
  static const Texts places = {"line",         "polygon", "position_m", "file",
                               "polygon_file", "fence",   "stems_file", "boulders_file"};
  const std::string path = path_of(change.group, change.name);
  bool has_place = false, may_have = false;
  for (const auto& [group, name, keys] : sections_in(site))
    for (const auto& key : keys) {
      if (path_of(group, name) != path || !has_name(places, key.name)) continue;
      may_have = true;
      has_place |= site.sources.contains(path + "." + key.name);
    }
  if (has_place || !may_have) return;
  throw InputError(
      {site.file, change.line},
      "[variant." + variant.name + "] changes " + path + ", which the site does not have",
      known.empty() ? "say where it is, and it is added"
                    : did_you_mean(change.name, known) + "; or say where it is, and it is added");
}

// The frequency of a class is that of all its sources together: it does not say how often rocks
// come from those that are left.
void check_what_is_left(const Site& site, const VariantSettings& variant) {
  const auto is_source = [&site](const std::string& path) {
    return path.starts_with("rockfall.") || (path.starts_with("blocks.") && moves_alone(site));
  };
  const auto taken = std::find_if(variant.without.begin(), variant.without.end(), is_source);
  if (taken == variant.without.end()) return;
  for (const HazardClassSettings& of : site.hazard_classes) {
    const bool has_frequency = !std::isnan(of.frequency_per_a) || !std::isnan(of.events) ||
                               !std::isnan(of.failure_probability);
    const bool is_changed = std::any_of(variant.changes.begin(), variant.changes.end(),
                                        [&of](const VariantSettings::Change& c) {
                                          return c.group == "hazard.class" && c.name == of.name;
                                        });
    if (!has_frequency || is_changed) continue;
    throw InputError(where_of(site, "variant." + variant.name + ".without"),
                     "[variant." + variant.name + "] is without " + *taken +
                         ", and the frequency of [hazard.class." + of.name +
                         "] is that of all sources together: it would all come from the others",
                     "take it out of the class and give each [rockfall.*] its frequency_per_a; or "
                     "change it in [variant." +
                         variant.name + "] too");
  }
}

}  // namespace

void apply_variant(Site& site, const std::string& name) {
  const auto at = std::find_if(site.variants.begin(), site.variants.end(),
                               [&name](const auto& one) { return one.name == name; });
  if (at == site.variants.end())
    throw InputError({site.file}, "has no section [variant." + name + "]",
                     did_you_mean(name, names_in(site, "variant")));
  const VariantSettings variant = *at;
  if (is_alternative(variant)) {
    if (!site.alternative.empty())
      throw InputError({site.file, variant.line},
                       "variants " + site.alternative + " and " + name +
                           " both have a weight, and are alternatives of one another",
                       "give one of them");
    site.alternative = name;
  } else {
    site.measures.push_back(name);
  }
  bool has_others = !variant.without.empty();
  for (const std::string& path : variant.without) take_out(site, variant, path);
  const Site before = site;
  for (const VariantSettings::Change& change : variant.changes) take_change(site, variant, change);
  for (const VariantSettings::Change& change : variant.changes) {
    const Texts known = names_in(before, change.group);
    if (change.name.empty() || has_name(known, change.name)) continue;
    check_new_section(site, variant, change, known);
    has_others = true;
  }
  if (has_others && is_alternative(variant))
    throw InputError({site.file, variant.line},
                     "[variant." + name + "] has a weight and other sections than the site",
                     "write the sections on the site, not active where they have that key");
  check_what_is_left(site, variant);
  fill_from_soils(site);
  check_names(site);
}

void check_variants(const Site& site) {
  const VariantSettings* first = nullptr;
  int n_weights = 0;
  for (const VariantSettings& variant : site.variants) {
    const Where where{site.file, variant.line};
    if (variant.name.find('/') != std::string::npos || variant.name[0] == '.')
      throw InputError(where, "the name of [variant." + variant.name + "] begins with . or holds /",
                       "its results go to a folder of that name");
    Site copy = site;
    apply_variant(copy, variant.name);
    if (!is_alternative(variant)) continue;
    if (first == nullptr) first = &variant;
    ++n_weights;
    if (!std::isnan(variant.cost))
      throw InputError(where_of(site, "variant." + variant.name + ".cost"),
                       "[variant." + variant.name + "] has a weight and a cost",
                       "an alternative of nature has the weight, a measure the cost");
  }
  if (n_weights == 1)
    throw InputError({site.file, first->line}, "[variant." + first->name + "] alone has a weight",
                     "the site as it is counts too where a variant has its weight alone: "
                     "[variant.as_it_is] and weight = 1");
}

void take_sections(Site& site, const std::vector<LayerSection>& sections) {
  for (const LayerSection& section : sections) {
    const std::string path = path_of(section.group, section.name);
    if (!section.name.empty()) check_name(section.group, section.name, {section.place});
    for_each_group(site,
                   SectionFinder{section.group, section.name, [&](const Keys<Field>& keys) {
                                   for (const LayerSection::Value& value : section.values)
                                     SectionTaker{site, section}.take_value(keys, path, value);
                                 }});
    site.layer_digests[path] += section.digest;
    note_section(site, section.group);
  }
  fill_from_soils(site);
  check_names(site);
}

void take_quantities(Site& site, const std::string& text, const std::string& path) {
  const Site other = parse_site(text, path);
  for (const auto& [key, source] : other.sources) {
    const std::size_t last = key.rfind('.');
    if (key.starts_with("uncertainty.") && last != std::string("uncertainty").size()) continue;
    throw InputError({path, source.line}, "holds " + key + ", expected [uncertainty.NAME] alone",
                     "take it into the site file, or out");
  }
  if (other.quantities.empty())
    throw InputError({path}, "holds no section [uncertainty.NAME]",
                     "take [uncertainty] file out of the site file");
  std::erase_if(site.sources, [&site](const auto& source) {
    return std::any_of(site.quantities.begin(), site.quantities.end(),
                       [&source](const QuantitySettings& quantity) {
                         return source.first.starts_with("uncertainty." + quantity.name + ".");
                       });
  });
  site.quantities = other.quantities;
  for (const auto& [key, source] : other.sources)
    site.sources[key] = {ValueSource::from_layer, 0,
                         path + ", line " + std::to_string(source.line)};
}

}  // namespace talus
