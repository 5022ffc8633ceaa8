// Fields of a block's verdict at a fence, with its arrival.
#include "post/fence/fence_fields.hpp"

#include "base/units.hpp"
#include "post/fence/fence_text.hpp"

namespace talus {
namespace {

constexpr FieldType words = FieldType::text, whole = FieldType::integer;
constexpr double kilo = 1e3;

using Value = FieldValue;
using Row = const VerdictRow&;
using Arrival = const FenceArrival&;

// None of a block that did not arrive.
template <class Get>
Value of(Row r, const Get& get) {
  return r.arrival == nullptr ? Value() : Value(get(*r.arrival));
}

}  // namespace

const std::vector<Field<VerdictRow>>& verdict_fields() {
  static const std::vector<Field<VerdictRow>> fields = {
      {"fence", "", "Fence", [](Row r) -> Value { return r.fence.name; }, words},
      {"run_id", "", "Run", [](Row r) -> Value { return r.group.members[r.run].info.run_id; },
       words},
      {"block", "", "Block", [](Row r) -> Value { return r.verdict.block; }, whole},
      {"verdict", "", "Verdict", [](Row r) -> Value { return text(r.verdict.verdict); }, words},
      {"weight", "", "Weight in statistics",
       [](Row r) -> Value { return r.group.runs[r.run].weight[r.verdict.block]; }},
      {"volume_m3", "m3", "Volume",
       [](Row r) -> Value { return r.group.runs[r.run].volume[r.verdict.block]; }},
      {"recorded_at", "", "Recorded at",
       [](Row r) { return of(r, [](Arrival a) { return std::string(recorded_at(a)); }); }, words},
      {"time_s", "s", "Time", [](Row r) { return of(r, [](Arrival a) { return a.time; }); }},
      {"chainage_m", "m", "Place along the fence",
       [](Row r) { return of(r, [](Arrival a) { return a.chainage; }); }},
      {"speed_m_s", "m/s", "Speed", [](Row r) { return of(r, [](Arrival a) { return a.speed; }); }},
      {"angle_to_normal_deg", "deg", "Angle to the normal",
       [](Row r) {
         return r.arrival != nullptr && r.arrival->beside
                    ? Value()
                    : of(r, [](Arrival a) { return a.angle / degree; });
       }},
      {"spin_rad_s", "rad/s", "Spin",
       [](Row r) { return of(r, [](Arrival a) { return a.spin; }); }},
      {"energy_kj", "kJ", "Kinetic energy, with spin",
       [](Row r) { return of(r, [](Arrival a) { return a.energy() / kilo; }); }},
      {"translational_energy_kj", "kJ", "Kinetic energy of translation",
       [](Row r) { return of(r, [](Arrival a) { return a.translation / kilo; }); }},
      {"rotational_energy_kj", "kJ", "Kinetic energy of rotation",
       [](Row r) { return of(r, [](Arrival a) { return a.rotation / kilo; }); }},
      {"centroid_height_m", "m", "Height of the centroid above the base",
       [](Row r) { return of(r, [](Arrival a) { return a.centroid; }); }},
      {"top_height_m", "m", "Height of the top above the base",
       [](Row r) { return of(r, [](Arrival a) { return a.top; }); }},
      {"bottom_height_m", "m", "Height of the lowest point above the base",
       [](Row r) { return of(r, [](Arrival a) { return a.bottom; }); }}};
  return fields;
}

std::string verdict_csv(const std::vector<FenceCase>& fences, const FenceRunGroup& group) {
  std::string out = csv_row(names_of(verdict_fields()));
  for (std::size_t i = 0; i < fences.size(); ++i)
    for (int r = 0; r < n_runs(group); ++r) {
      const auto& at = group.runs[r].at_fence[i];
      for (const BlockVerdict& v : at.verdicts)
        out += csv_row(values_of(
            verdict_fields(),
            {fences[i].fence, group, r, v, v.arrival < 0 ? nullptr : &at.arrivals[v.arrival]}));
    }
  return out;
}

}  // namespace talus
