// Doubts of a tool: their options, messages and layer; ends the tool where one is refused.
#include "tools/frame/doubts.hpp"

#include <algorithm>
#include <utility>

#include "base/fields.hpp"
#include "io/geopackage_gdal.hpp"

namespace talus {
namespace {

FieldValue text_or_null(const std::string& words) {
  return words.empty() ? FieldValue() : FieldValue(words);
}

const std::vector<Field<Doubt>>& doubt_fields() {
  using D = const Doubt&;
  static const std::vector<Field<Doubt>> fields = {
      {"what", "", "What", [](D d) { return text_or_null(d.what); }, FieldType::text},
      {"file", "", "File", [](D d) { return text_or_null(d.where.text()); }, FieldType::text},
      {"feature", "", "Feature",
       [](D d) { return d.feature < 0 ? FieldValue() : FieldValue(d.feature); },
       FieldType::integer},
      {"found", "", "Found", [](D d) { return text_or_null(d.found); }, FieldType::text},
      {"expected", "", "Expected", [](D d) { return text_or_null(d.expected); }, FieldType::text},
      {"hint", "", "Way out", [](D d) { return text_or_null(d.hint); }, FieldType::text},
      {"value", "", "Found, as a number", [](D d) -> FieldValue { return d.value; }},
      {"low", "", "Expected, lower bound", [](D d) -> FieldValue { return d.low; }},
      {"high", "", "Expected, upper bound", [](D d) -> FieldValue { return d.high; }},
      {"state", "", "State", [](D d) -> FieldValue { return std::string(text(d.state)); },
       FieldType::text}};
  return fields;
}

void write_layer(Tool& tool, const DoubtOptions& options) {
  if (options.layer.empty()) return;
  VectorLayer layer;
  layer.name = "doubts";
  layer.type = GeometryType::point;
  layer.description = "what to look at before the result is used";
  layer.fields = vector_fields(doubt_fields());
  for (const Doubt& doubt : tool.doubts_found()) {
    VectorFeature& feature = layer.features.emplace_back();
    // the middle of an extent
    if (!doubt.at.empty()) feature.points = {(doubt.at.front() + doubt.at.back()) / 2};
    feature.values = values_of(doubt_fields(), doubt);
  }
  write_geopackage(tool.stage_also_if_refused(options.layer), options.crs_wkt, {layer});
}

}  // namespace

void declare_doubts_layer(Tool& tool, DoubtOptions& options) {
  tool.output("--doubts", options.layer,
              "what to look at, as places, also of an input that is refused (GeoPackage)");
  tool.at_end([&tool, &options] { write_layer(tool, options); });
}

void declare_doubts(Tool& tool, DoubtOptions& options, const std::string& accept) {
  declare_doubts_layer(tool, options);
  tool.flag("--accept-doubts", options.accept, accept);
}

std::string judge(Tool& tool, const DoubtOptions& options, std::vector<Doubt> doubts) {
  if (options.accept) accept(doubts);
  tool.doubts(doubts);
  Doubt refusal = refusal_of(doubts);
  if (refusal.state != DoubtState::refused) return accepted_places(doubts);
  if (doubts.size() > 1)
    refusal.hint += options.layer.empty() ? "; --doubts places.gpkg writes all places"
                                          : "; all places are in " + options.layer;
  throw InputError(std::move(refusal));
}

}  // namespace talus
