// Finds and reads the field of a layer that may hold its heights.
#include "import/height_field_gdal.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ranges>
#include <utility>

#include "base/text.hpp"
#include "base/words.hpp"
#include "import/readings.hpp"

namespace talus {
namespace {

// Names under which elevations are found, the most telling first; compared in lower case.
constexpr std::array elevation_names = {
    "elev",         "elevation", "height",     "contour",     "z",        "prop_value", "altitude",
    "alt",          "hoehe",     "höhe",       "kote",        "cota",     "quota",      "elev_m",
    "height_m",     "z_value",   "contour_m",  "elevation_m", "isohypse", "hgt",        "elev_ft",
    "elevation_ft", "height_ft", "contour_ft", "elev_feet",   "h"};

std::string name_of_field(OGRLayer& layer, int index) {
  return layer.GetLayerDefn()->GetFieldDefn(index)->GetNameRef();
}

// "Height" of "Height (m)".
std::string without_unit(const std::string& name) {
  std::string plain = name.substr(0, name.find_first_of("(["));
  plain.erase(plain.find_last_not_of(' ') + 1);
  return plain;
}

// Fields with a usual name, the most telling first.
std::vector<int> fields_with_usual_name(OGRLayer& layer) {
  std::vector<int> found;
  for (const char* name : elevation_names)
    for (int i = 0; i < layer.GetLayerDefn()->GetFieldCount(); ++i)
      if (lower(without_unit(name_of_field(layer, i))) == name) found.push_back(i);
  return found;
}

}  // namespace

std::string field_option(const OpenLayer& source) {
  return option_words(source.role, "--elevation-field");
}

int find_index(OGRLayer& layer, const std::string& name) {
  int found = -1;
  for (int i = layer.GetLayerDefn()->GetFieldCount() - 1; i >= 0; --i) {
    if (name_of_field(layer, i) == name) return i;
    if (lower(name_of_field(layer, i)) == lower(name)) found = i;
  }
  return found;
}

std::string list_of_fields(OGRLayer& layer) {
  return list_of(std::views::iota(0, layer.GetLayerDefn()->GetFieldCount()),
                 [&layer](int i) { return name_of_field(layer, i); });
}

bool differ(double a, double b) { return std::abs(a - b) > 1e-3 * std::max(1.0, std::abs(a)); }

bool is_in_feet(const std::string& name) {
  std::string small = lower(name);
  std::erase_if(small, [](char c) { return c == ')' || c == ']' || c == ' '; });
  for (const char* end : {"_ft", "feet", "_foot", "(ft", "[ft", "(foot", "[foot"})
    if (small.ends_with(end)) return true;
  return false;
}

std::optional<HeightField> HeightField::find(const OpenLayer& source) {
  if (source.ref.elevation_field.empty()) return by_name(source);
  return by_user(source);
}

HeightField HeightField::by_user(const OpenLayer& source) {
  const std::string& wanted = source.ref.elevation_field;
  const std::string lower_name = lower(wanted);
  HeightField field;
  field.by_user_ = true;
  field.name_ = "Z";
  if (lower_name == "geometry.z") return field;
  const bool says_field = lower_name.rfind("field.", 0) == 0;
  const std::string name = wanted.substr(says_field ? 6 : 0);
  const bool may_be_z = !says_field && lower_name == "z";
  for (OGRLayer* layer : source.layers) {
    const int index = find_index(*layer, name);
    const bool is_first = field.index_.empty();
    if (index < 0 && is_first && may_be_z) return field;
    if (index < 0)
      throw InputError(
          {source.ref.path, 0, std::string("layer ") + layer->GetName()},
          "there is no field \"" + name + "\"; the fields are: " + list_of_fields(*layer),
          "choose one with " + field_option(source) + "FIELD, or Z for the geometries' own Z");
    if (is_first) field.name_ = name_of_field(*layer, index);
    field.index_.push_back(index);
  }
  field.may_be_z_ = may_be_z;
  return field;
}

std::optional<HeightField> HeightField::by_name(const OpenLayer& source) {
  HeightField field;
  for (OGRLayer* layer : source.layers) {
    std::vector<int> found = fields_with_usual_name(*layer);
    if (found.empty()) return std::nullopt;
    const std::string name = name_of_field(*layer, found.front());
    if (field.name_.empty())
      field.name_ = name;
    else if (field.name_.find(name) == std::string::npos)
      field.name_ += ", " + name;
    field.index_.push_back(found.front());
    found.erase(found.begin());
    std::erase_if(found, [layer](int i) { return is_in_feet(name_of_field(*layer, i)); });
    field.others_.push_back(std::move(found));
  }
  return field;
}

double HeightField::value_of(const OpenLayer& source, const OGRFeature& feature) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto refuse = [&](const std::string& finding, const std::string& hint) {
    if (!problem_) problem_.emplace(where_of_feature(source, feature), finding, hint);
    return none;
  };
  const int index = index_[source.current];
  const std::string other = "choose another field with " + field_option(source) + "FIELD, or ";
  if (!feature.IsFieldSetAndNotNull(index))
    return refuse("the field " + name_ + " is empty, expected an elevation",
                  other + "Z for the geometries' own Z");
  const OGRFieldType type = feature.GetFieldDefnRef(index)->GetType();
  double value = 0;
  if (type == OFTInteger || type == OFTInteger64 || type == OFTReal) {
    value = feature.GetFieldAsDouble(index);
  } else {
    const std::string words = feature.GetFieldAsString(index);
    if (type == OFTString) thousands_.add(words);
    if (!parse_double(words, value))
      return refuse("the field " + name_ + " says \"" + words + "\", expected an elevation",
                    other + "mend the text");
  }
  if (std::isfinite(value)) return value;
  return refuse("the field " + name_ + " is " + text(value) + ", expected an elevation", "");
}

void HeightField::add(const OpenLayer& source, const OGRFeature& feature) {
  if (is_z()) return;
  values_.push_back(value_of(source, feature));
  if (others_.empty()) return;
  for (const int index : others_[source.current]) add_rival(feature, index);
}

// One that has the same value everywhere holds no elevations.
void HeightField::add_rival(const OGRFeature& feature, int index) {
  double value = 0;
  if (!feature.IsFieldSetAndNotNull(index) || !parse_double(feature.GetFieldAsString(index), value))
    return;
  const std::string name = feature.GetFieldDefnRef(index)->GetNameRef();
  Rival& rival = rivals_.try_emplace(name, Rival{value, value, ""}).first->second;
  rival.low = std::min(rival.low, value), rival.high = std::max(rival.high, value);
  if (rival.contradiction.empty() && differ(values_.back(), value))
    rival.contradiction = "feature " + std::to_string(feature.GetFID()) + " has " + name_ + " " +
                          text(values_.back(), 8) + " and " + name + " " + text(value, 8) +
                          ", expected the same height";
}

const std::vector<double>& HeightField::heights(const OpenLayer& source) const {
  if (problem_) throw InputError(*problem_);
  const std::string option = field_option(source);
  if (thousands_.is_doubtful()) {  // 1.010 may be 1.01 or 1010
    std::string whole = thousands_.first();
    whole.erase(1, 1);
    throw InputError(where_of_layer(source),
                     "the field " + name_ + " holds text like \"" + thousands_.first() +
                         "\", which may be " + thousands_.first() +
                         " m or, with a point between thousands, " + whole + " m",
                     "make a field of numbers of it (field calculator of QGIS: "
                     "to_real(replace(\"" +
                         name_ + "\", '.', '')) for thousands, to_real(\"" + name_ +
                         "\") for metres) and name it with " + option + "FIELD");
  }
  for (const auto& [name, rival] : rivals_) {
    if (by_user_ || rival.contradiction.empty() || rival.low == rival.high) continue;
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    throw InputError(
        choice_of(where_of_layer(source), rival.contradiction,
                  {{"by " + name_, rise_words(*low, *high, 0), option + name_},
                   {"by " + name, rise_words(rival.low, rival.high, 0), option + name}}));
  }
  return values_;
}

}  // namespace talus
