#include "tools/frame/doubts_layer.hpp"

#include "base/text.hpp"
#include "io/geopackage_gdal.hpp"

namespace talus {

double difference_of(const DoubtRow& row) {
  const double z = row.place.z();
  if (z > row.expected_high) return z - row.expected_high;
  return z < row.expected_low ? z - row.expected_low
                              : row.expected_high - row.expected_high;  // 0, or NaN
}

std::string accepted_places(const std::vector<DoubtRow>& rows) {
  constexpr std::int64_t most = 20;
  std::int64_t n = 0;
  std::string words;
  for (const DoubtRow& row : rows) {
    if (row.outcome != "accepted" || ++n > most) continue;
    words += (words.empty() ? "" : "; ") + row.what + " at " + text(row.place.z(), 8) + " m, x " +
             text(row.place.x(), 10) + ", y " + text(row.place.y(), 10);
  }
  if (n > most) words += "; " + std::to_string(n - most) + " more";
  return words;
}

void write_doubts(Tool& tool, const std::string& path, const std::string& crs_wkt,
                  const std::vector<DoubtRow>& rows) {
  if (path.empty()) return;
  VectorLayer layer;
  layer.name = "doubts";
  layer.description = "places to look at before the result is used";
  layer.fields = {{"what", FieldType::text},
                  {"feature", FieldType::integer},
                  {"height_m", FieldType::real},
                  {"expected_low_m", FieldType::real},
                  {"expected_high_m", FieldType::real},
                  {"difference_m", FieldType::real},
                  {"moved_m", FieldType::real},
                  {"outcome", FieldType::text}};
  for (const DoubtRow& row : rows) {
    VectorFeature feature;
    feature.points = {row.place};
    feature.values = {row.what,          row.feature < 0 ? FieldValue() : FieldValue(row.feature),
                      row.place.z(),     row.expected_low,
                      row.expected_high, difference_of(row),
                      row.moved,         row.outcome};
    layer.features.push_back(std::move(feature));
  }
  write_geopackage(tool.stage_also_if_refused(path), crs_wkt, {layer});
}

}  // namespace talus
