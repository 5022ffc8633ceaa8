// Fields of observations beside results: boulders, scars, outlines.
#include "post/observed/observed_fields.hpp"

namespace talus {
namespace {

constexpr FieldType words = FieldType::text, whole = FieldType::integer;
using Value = FieldValue;

Value date_of(const ObservedPoint& point) {
  return point.date.empty() ? Value() : Value(point.date);
}

}  // namespace

const std::vector<Field<BoulderRow>>& boulder_fields() {
  using Row = const BoulderRow&;
  static const std::vector<Field<BoulderRow>> fields = {
      {"event", "", "Event", [](Row r) -> Value { return r.event; }, words},
      {"date", "", "Date", [](Row r) { return date_of(r.point); }, words},
      {"volume_m3", "m3", "Volume", [](Row r) -> Value { return r.point.size; }},
      {"runout_m", "m", "Run-out in plan", [](Row r) -> Value { return r.at.runout; }},
      {"across_m", "m", "Distance across the mean direction, positive to the left",
       [](Row r) -> Value { return r.at.across; }},
      {"percentile", "", "Share of the computed run-outs that are not longer",
       [](Row r) -> Value { return r.percentile.share; }},
      {"percentile_lo", "", "The same, lower bound",
       [](Row r) -> Value { return r.percentile.interval.low; }},
      {"percentile_hi", "", "The same, upper bound",
       [](Row r) -> Value { return r.percentile.interval.high; }},
      {"volume_percentile", "", "Share of the computed blocks that are not larger",
       [](Row r) -> Value { return r.volume_share; }},
      {"in_reach", "", "Whether a computed block passed there",
       [](Row r) -> Value { return r.is_in_reach ? 1 : 0; }, whole}};
  return fields;
}

const std::vector<Field<ScarRow>>& scar_fields() {
  using Row = const ScarRow&;
  static const std::vector<Field<ScarRow>> fields = {
      {"event", "", "Event", [](Row r) -> Value { return r.event; }, words},
      {"date", "", "Date", [](Row r) { return date_of(r.point); }, words},
      {"height_m", "m", "Height above the ground", [](Row r) -> Value { return r.point.size; }},
      {"n_passes", "", "Number of computed blocks that passed there",
       [](Row r) -> Value { return r.n_passes; }, whole},
      {"percentile", "", "Share of the computed heights that are not above it",
       [](Row r) -> Value { return r.percentile.share; }},
      {"percentile_lo", "", "The same, lower bound",
       [](Row r) -> Value { return r.percentile.interval.low; }},
      {"percentile_hi", "", "The same, upper bound",
       [](Row r) -> Value { return r.percentile.interval.high; }},
      {"height_p50_m", "m", "Computed height of the centroid, median",
       [](Row r) -> Value { return r.p50; }},
      {"height_p95_m", "m", "Computed height of the centroid, 95th percentile",
       [](Row r) -> Value { return r.p95; }}};
  return fields;
}

const std::vector<Field<OutlineRow>>& outline_fields() {
  using Row = const OutlineRow&;
  static const std::vector<Field<OutlineRow>> fields = {
      {"event", "", "Event", [](Row r) -> Value { return r.event; }, words},
      {"inside_share", "", "Share of the computed deposit within it",
       [](Row r) -> Value { return r.score.inside.share; }},
      {"inside_share_lo", "", "The same, lower bound",
       [](Row r) -> Value { return r.score.inside.interval.low; }},
      {"inside_share_hi", "", "The same, upper bound",
       [](Row r) -> Value { return r.score.inside.interval.high; }},
      {"reached_share", "", "Share of its area that computed blocks pass over",
       [](Row r) -> Value { return r.score.reached_share; }}};
  return fields;
}

}  // namespace talus
