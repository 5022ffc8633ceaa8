// Symbol and form by which QGIS shows a layer of a site.gpkg.
#include "tools/site/layer_form.hpp"

#include <algorithm>
#include <map>

#include "base/text.hpp"
#include "io/style.hpp"

namespace talus {
namespace {

constexpr const char* null_of_qgis = "{2839923C-8B7D-419E-B84B-CA2FE9B80EC7}";

std::vector<std::string> parted(const std::string& words, char sign) {
  std::vector<std::string> parts(1);
  for (const char c : words) {
    if (c == sign)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + xml_escaped(value) + "\"";
}

// --- name of a field, and its allowed values -----------------------------------------------------

// "height_m" -> "m"
std::string unit_of(const std::string& key) {
  static const std::vector<std::pair<std::string, std::string>> units = {
      {"_m3", "m³"},   {"_deg", "°"},     {"_kj", "kJ"},       {"_cm", "cm"}, {"_kpa", "kPa"},
      {"_1_m", "1/m"}, {"_per_a", "1/a"}, {"_per_ha", "1/ha"}, {"_m", "m"}};
  for (const auto& [end, unit] : units)
    if (key.ends_with(end)) return unit;
  return "";
}

// The help of a key up to where it explains, its unit, and the value of an empty field.
std::string alias_of(const KeyDescription& key) {
  std::string words = key.help.substr(0, std::min(key.help.find_first_of(":;,("), key.help.size()));
  while (!words.empty() && words.back() == ' ') words.pop_back();
  const std::string unit = unit_of(key.key);
  if (!unit.empty()) words += " [" + unit + "]";
  if (!key.default_value.empty()) words += ", if empty " + key.default_value;
  return words;
}

// "above 0 to below 90" as an expression of QGIS; empty: anything.
std::string limits_of(const KeyDescription& key) {
  if (key.type != "number" && key.type != "whole number") return "";
  const std::string field = "\"" + key.key + "\"";
  std::string out;
  const auto add = [&](const char* sign, const std::string& number) {
    out += (out.empty() ? "" : " and ") + field + sign + number;
  };
  std::vector<std::string> words = parted(key.range, ' ');
  for (std::size_t i = 0; i < words.size(); ++i) {
    double number = 0;
    if (!parse_double(words[i], number)) continue;
    const std::string before = i > 0 ? words[i - 1] : "";
    if (before == "above")
      add(" > ", words[i]);
    else if (before == "below")
      add(" < ", words[i]);
    else
      add(before == "to" ? " <= " : " >= ", words[i]);
  }
  return out.empty() ? "" : field + " is null or (" + out + ")";
}

// --- the form ------------------------------------------------------------------------------------

std::string choice(const std::string& shown, const std::string& value) {
  return "<Option type=\"Map\"><Option type=\"QString\"" + attribute("name", shown) +
         attribute("value", value) + "/></Option>";
}

std::string widget_of(const KeyDescription& key) {
  if (key.type == "true or false") return "CheckBox\"><config><Option/></config>";
  if (key.type != "text" || key.range.empty())
    return "TextEdit\"><config><Option type=\"Map\"><Option type=\"bool\" name=\"IsMultiline\" "
           "value=\"false\"/></Option></config>";
  std::string out = "ValueMap\"><config><Option type=\"Map\"><Option type=\"List\" name=\"map\">" +
                    choice("not given", null_of_qgis);
  for (const std::string& word : parted(key.range, '|')) out += choice(word, word);
  return out + "</Option></Option></config>";
}

std::string field_xml(const std::string& name, const std::string& widget) {
  return "    <field" + attribute("name", name) +
         " configurationFlags=\"None\"><editWidget type=\"" + widget + "</editWidget></field>\n";
}

std::string constraint_xml(const std::string& name, bool is_needed, bool has_limits) {
  return "    <constraint" + attribute("field", name) +
         attribute("constraints", std::to_string((is_needed ? 1 : 0) + (has_limits ? 4 : 0))) +
         attribute("notnull_strength", is_needed ? "1" : "0") + " unique_strength=\"0\"" +
         attribute("exp_strength", has_limits ? "1" : "0") + "/>\n";
}

std::string form_xml(const SiteLayer& layer) {
  constexpr const char* hidden = "Hidden\"><config><Option/></config>";
  constexpr const char* line = "TextEdit\"><config><Option/></config>";
  std::string fields = field_xml("fid", hidden), aliases, constraints, expressions, defaults;
  int index = 1;
  const auto add_alias = [&](const std::string& name, const std::string& words) {
    aliases += "    <alias" + attribute("index", std::to_string(index++)) +
               attribute("field", name) + attribute("name", words) + "/>\n";
  };
  if (has_names(layer)) {
    fields += field_xml("name", line);
    add_alias("name", "name: [" + layer.section + ".NAME]");
    constraints += constraint_xml("name", true, false);
  }
  for (const KeyDescription& key : fields_of(layer)) {
    fields += field_xml(key.key, widget_of(key));
    add_alias(key.key, alias_of(key));
    // A box that nobody ticks writes false, where an empty field would mean true.
    if (key.type == "true or false")
      defaults += "    <default" + attribute("field", key.key) +
                  attribute("expression", key.default_value) + " applyOnUpdate=\"0\"/>\n";
    const std::string limits = limits_of(key);
    constraints += constraint_xml(key.key, false, !limits.empty());
    if (!limits.empty())
      expressions += "    <constraint" + attribute("field", key.key) + attribute("exp", limits) +
                     attribute("desc", key.range) + "/>\n";
  }
  fields += field_xml("remark", line);
  add_alias("remark", "remark, not read");
  return "  <fieldConfiguration>\n" + fields + "  </fieldConfiguration>\n  <aliases>\n" + aliases +
         "  </aliases>\n  <constraints>\n" + constraints +
         "  </constraints>\n  <constraintExpressions>\n" + expressions +
         "  </constraintExpressions>\n  <defaults>\n" + defaults +
         "  </defaults>\n  <editorlayout>generatedlayout</editorlayout>\n"
         "  <previewExpression>" +
         std::string(has_names(layer) ? "\"name\"" : "\"fid\"") + "</previewExpression>\n";
}

VectorStyle style_of(const SiteLayer& layer) {
  static const std::map<std::string, Colour> colours = {
      {"release_points", {178, 24, 43, 255}}, {"object_points", {84, 39, 136, 255}},
      {"fences", {0, 90, 181, 255}},          {"object_lines", {84, 39, 136, 255}},
      {"objects", {84, 39, 136, 110}},        {"places", {64, 64, 64, 40}},
      {"source", {178, 24, 43, 70}},          {"forest", {27, 120, 55, 60}},
      {"grounds", {140, 81, 10, 50}},         {"release_areas", {178, 24, 43, 70}},
      {"observed_boulders", {0, 0, 0, 255}},  {"observed_scars", {27, 120, 55, 255}},
      {"observed_outlines", {0, 0, 0, 30}},   {"dams", {127, 59, 8, 255}}};
  const SymbolKind kind = layer.shape == SiteLayer::points  ? SymbolKind::point
                          : layer.shape == SiteLayer::lines ? SymbolKind::line
                                                            : SymbolKind::polygon;
  const double size = kind == SymbolKind::point                        ? 3
                      : layer.name == "fences" || layer.name == "dams" ? 1
                                                                       : 0.5;
  return {kind, "", {{"", "", colours.at(layer.name)}}, size, has_names(layer) ? "\"name\"" : ""};
}

}  // namespace

std::vector<KeyDescription> fields_of(const SiteLayer& layer) {
  const std::string section = has_names(layer) ? layer.section + ".NAME" : layer.section;
  std::vector<KeyDescription> fields;
  for (const std::string& name : layer.fields)
    for (const KeyDescription& key : site_keys())
      if (key.section == section && key.key == name) fields.push_back(key);
  fields.insert(fields.end(), layer.attributes.begin(), layer.attributes.end());
  return fields;
}

std::string layer_form_qml(const SiteLayer& layer) {
  std::string qml = vector_qml(style_of(layer));
  const std::size_t end = qml.rfind("</qgis>");
  return qml.insert(end, form_xml(layer));
}

}  // namespace talus
