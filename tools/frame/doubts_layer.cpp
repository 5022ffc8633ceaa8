#include "tools/frame/doubts_layer.hpp"

#include "base/text.hpp"
#include "io/geopackage_gdal.hpp"

namespace talus {
namespace {

const std::vector<Field<DoubtRow>>& doubt_fields() {
  using Value = FieldValue;
  using Row = const DoubtRow&;
  static const std::vector<Field<DoubtRow>> fields = {
      {"what", "", "What", [](Row r) -> Value { return r.what; }, FieldType::text},
      {"feature", "", "Feature", [](Row r) { return r.feature < 0 ? Value() : Value(r.feature); },
       FieldType::integer},
      {"height_m", "m", "Height", [](Row r) -> Value { return r.place.z(); }},
      {"expected_low_m", "m", "Expected, lower bound",
       [](Row r) -> Value { return r.expected_low; }},
      {"expected_high_m", "m", "Expected, upper bound",
       [](Row r) -> Value { return r.expected_high; }},
      {"difference_m", "m", "Difference", [](Row r) -> Value { return difference_of(r); }},
      {"moved_m", "m", "Moved by", [](Row r) -> Value { return r.moved; }},
      {"outcome", "", "Outcome", [](Row r) -> Value { return r.outcome; }, FieldType::text}};
  return fields;
}

}  // namespace

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
  layer.fields = vector_fields(doubt_fields());
  for (const DoubtRow& row : rows) {
    VectorFeature feature;
    feature.points = {row.place};
    feature.values = values_of(doubt_fields(), row);
    layer.features.push_back(std::move(feature));
  }
  write_geopackage(tool.stage_also_if_refused(path), crs_wkt, {layer});
}

}  // namespace talus
