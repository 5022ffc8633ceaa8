#include "tools/frame/doubts.hpp"

#include <algorithm>
#include <utility>

#include "io/geopackage_gdal.hpp"
#include "tools/frame/options.hpp"

namespace talus {
namespace {

FieldValue text_or_null(const std::string& words) {
  return words.empty() ? FieldValue() : FieldValue(words);
}

// The middle of an extent.
VectorFeature feature_of(const Doubt& doubt) {
  VectorFeature feature;
  if (!doubt.at.empty()) feature.points = {(doubt.at.front() + doubt.at.back()) / 2};
  feature.values = {text_or_null(doubt.what),
                    text_or_null(doubt.where.text()),
                    doubt.feature < 0 ? FieldValue() : FieldValue(doubt.feature),
                    text_or_null(doubt.found),
                    text_or_null(doubt.expected),
                    text_or_null(doubt.hint),
                    doubt.value,
                    doubt.low,
                    doubt.high,
                    text(doubt.state)};
  return feature;
}

void write_layer(Tool& tool, const DoubtOptions& options) {
  if (options.layer.empty()) return;
  VectorLayer layer;
  layer.name = "doubts";
  layer.type = GeometryType::point;
  layer.description = "what to look at before the result is used";
  layer.fields = {{"what", FieldType::text},       {"file", FieldType::text},
                  {"feature", FieldType::integer}, {"found", FieldType::text},
                  {"expected", FieldType::text},   {"hint", FieldType::text},
                  {"value", FieldType::real},      {"low", FieldType::real},
                  {"high", FieldType::real},       {"state", FieldType::text}};
  for (const Doubt& doubt : tool.doubts_found()) layer.features.push_back(feature_of(doubt));
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
