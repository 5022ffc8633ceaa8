// Results at fences as layers of the GeoPackage of talus-fence, with their styles.
#include "tools/fence/layers.hpp"

#include <cmath>

#include "base/units.hpp"
#include "io/style.hpp"
#include "post/fence/fence_fields.hpp"
#include "post/fence/fence_text.hpp"

namespace talus {
namespace {

VectorStyle verdict_style(SymbolKind kind, double size) {
  return {kind,
          "verdict",
          {{"stopped", "stopped", {51, 160, 44, 255}},
           {"pierced", "pierced", {227, 26, 28, 255}},
           {"free_border", "freeboard", {253, 191, 111, 255}},
           {"overtopped", "overtopped", {255, 127, 0, 255}},
           {"bypassed_left", "bypassed on the left", {106, 61, 154, 255}},
           {"bypassed_right", "bypassed on the right", {202, 178, 214, 255}},
           {"underpassed", "underpassed", {177, 89, 40, 255}}},
          size};
}

using Value = FieldValue;
constexpr FieldType words = FieldType::text, whole = FieldType::integer;
constexpr double kilo = 1e3;

// A fence, one of its fields or one of its posts, with the arrivals at it.
struct PartRow {
  const FenceCase& fence;
  const FenceResult& result;
  std::size_t number;  // of the field or post
  const FencePartSummary& part;
  const DesignResult& design;
};
using Row = const PartRow&;
using PartFields = std::vector<Field<PartRow>>;

const BoundedPercentile& p95(const QuantitySummary& quantity) {
  return quantity.percentile[place_of_p95];
}

const PartFields& arrival_fields() {
  static const PartFields fields = {
      {"n", "", "Number of arrivals", [](Row r) -> Value { return r.part.n; }, whole},
      {"per_run", "", "Arrivals a run", [](Row r) -> Value { return r.part.per_run; }},
      {"energy_p95_kj", "kJ", "Kinetic energy, 95th percentile",
       [](Row r) -> Value { return p95(r.part.energy).value / kilo; }},
      {"energy_p95_hi_kj", "kJ", "Kinetic energy, 95th percentile, upper bound",
       [](Row r) -> Value { return p95(r.part.energy).upper / kilo; }},
      {"energy_max_kj", "kJ", "Kinetic energy, largest",
       [](Row r) -> Value { return r.part.energy.largest / kilo; }},
      {"top_p95_m", "m", "Height of the top, 95th percentile",
       [](Row r) -> Value { return p95(r.part.top).value; }},
      {"top_p95_hi_m", "m", "Height of the top, 95th percentile, upper bound",
       [](Row r) -> Value { return p95(r.part.top).upper; }},
      {"top_max_m", "m", "Height of the top, largest",
       [](Row r) -> Value { return r.part.top.largest; }},
      {"speed_p95_m_s", "m/s", "Speed, 95th percentile",
       [](Row r) -> Value { return p95(r.part.speed).value; }},
      {"speed_max_m_s", "m/s", "Speed, largest",
       [](Row r) -> Value { return r.part.speed.largest; }},
      {"angle_to_normal_deg", "deg", "Angle to the normal, mean",
       [](Row r) -> Value { return r.part.mean_angle / degree; }},
      {"energy_in_one_second_kj", "kJ", "Largest sum of energies within a second",
       [](Row r) -> Value { return r.part.window_energy / kilo; }}};
  return fields;
}

PartFields joined(PartFields fields, const PartFields& more) {
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

// NULL where the energy could not be checked.
FieldValue pass_field(const DesignResult& design) {
  const std::optional<bool> pass = passes(design);
  if (!pass) return {};
  return static_cast<std::int64_t>(*pass ? 1 : 0);
}

std::vector<VectorStyle::Class> verdict_classes() {
  return {{"meets", "meets the code", {51, 160, 44, 255}},
          {"does not meet", "does not meet it", {227, 26, 28, 255}},
          {"energy not checked", "no capacity given: energy not checked", {253, 191, 111, 255}},
          {"too few arrivals", "not judged: too few arrivals", {120, 120, 120, 255}},
          {"first touches only", "not judged: first touches only", {120, 120, 120, 255}},
          {"still moving", "not judged: blocks still move", {120, 120, 120, 255}},
          {"from downhill", "not judged: blocks from downhill", {120, 120, 120, 255}},
          {"nothing came", "not judged: nothing came", {190, 190, 190, 255}}};
}

// The verdict of each fence as a whole: the one that terminal and report give.
const PartFields& whole_fields() {
  static const PartFields fields = {
      {"fence", "", "Fence", [](Row r) -> Value { return r.fence.fence.name; }, words},
      {"arrivals", "", "Number of arrivals", [](Row r) -> Value { return r.design.n_arrivals; },
       whole},
      {"design_energy_kj", "kJ", "Design energy",
       [](Row r) -> Value { return r.design.design_energy / kilo; }},
      {"required_capacity_kj", "kJ", "Required capacity",
       [](Row r) -> Value { return r.design.required_capacity / kilo; }},
      {"required_height_m", "m", "Required height",
       [](Row r) -> Value { return r.design.required_height; }},
      {"smallest_class", "", "Smallest class",
       [](Row r) -> Value { return r.design.smallest_class; }, words},
      {"basis", "", "Basis", [](Row r) -> Value { return basis_text(r.result); }, words},
      {"verdict", "", "Verdict", [](Row r) -> Value { return text(r.design.verdict); }, words},
      {"verdict_text", "", "Verdict in words", [](Row r) -> Value { return text(r.design); },
       words},
      {"pass", "", "Whether it meets the code", [](Row r) -> Value { return pass_field(r.design); },
       whole}};
  return fields;
}

// The verdict of each fence as a whole: the one that terminal and report give.
VectorLayer whole_layer(const std::vector<FenceCase>& fences,
                        const std::vector<FenceResult>& results, const Vec3& origin) {
  VectorLayer layer{"fences",
                    "the fences with the verdict of their design check",
                    GeometryType::line_zm,
                    vector_fields(whole_fields()),
                    {},
                    vector_qml({SymbolKind::line, "verdict", verdict_classes(), 1.4, "\"fence\""})};
  for (std::size_t i = 0; i < fences.size(); ++i) {
    const FenceResult& r = results[i];
    VectorFeature feature;
    for (const Vec3& post : fences[i].fence.post) feature.points.emplace_back(post + origin);
    feature.measure = fences[i].fence.chainage;
    feature.values = values_of(whole_fields(), {fences[i], r, 0, r.whole, r.design});
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

const PartFields& field_fields() {
  static const PartFields fields = joined(
      joined({{"fence", "", "Fence", [](Row r) -> Value { return r.fence.fence.name; }, words},
              {"field", "", "Field",
               [](Row r) -> Value { return static_cast<std::int64_t>(r.number); }, whole}},
             arrival_fields()),
      {{"storage_m3", "m3", "Storage",
        [](Row r) -> Value { return r.result.fields[r.number].storage; }},
       {"required_capacity_kj", "kJ", "Required capacity",
        [](Row r) -> Value { return r.design.required_capacity / kilo; }},
       {"required_height_m", "m", "Required height",
        [](Row r) -> Value { return r.design.required_height; }},
       {"smallest_class", "", "Smallest class",
        [](Row r) -> Value { return r.design.smallest_class; }, words},
       {"governs", "", "What governs", [](Row r) -> Value { return r.design.governs; }, words},
       {"pass", "", "Whether it meets the code",
        [](Row r) -> Value { return pass_field(r.design); }, whole},
       {"verdict", "", "Verdict", [](Row r) -> Value { return text(r.design.verdict); }, words},
       {"verdict_text", "", "Verdict in words", [](Row r) -> Value { return text(r.design); },
        words}});
  return fields;
}

VectorLayer field_layer(const std::vector<FenceCase>& fences,
                        const std::vector<FenceResult>& results, const Vec3& origin) {
  VectorLayer layer{"fence_fields",
                    "fields of the fences, each judged by the arrivals at it alone",
                    GeometryType::line_zm,
                    vector_fields(field_fields()),
                    {},
                    vector_qml({SymbolKind::line, "verdict", verdict_classes(), 1.2})};
  for (std::size_t i = 0; i < fences.size(); ++i)
    for (std::size_t f = 0; f < results[i].fields.size(); ++f) {
      const FieldResult& r = results[i].fields[f];
      const Fence& fence = fences[i].fence;
      VectorFeature feature;
      feature.points = {fence.post[f] + origin, fence.post[f + 1] + origin};
      feature.measure = {fence.chainage[f], fence.chainage[f + 1]};
      feature.values = values_of(field_fields(), {fences[i], results[i], f, r.part, r.design});
      layer.features.push_back(std::move(feature));
    }
  return layer;
}

const PartFields& post_fields() {
  static const PartFields fields =
      joined({{"fence", "", "Fence", [](Row r) -> Value { return r.fence.fence.name; }, words},
              {"post", "", "Post",
               [](Row r) -> Value { return static_cast<std::int64_t>(r.number); }, whole}},
             arrival_fields());
  return fields;
}

VectorLayer post_layer(const std::vector<FenceCase>& fences,
                       const std::vector<FenceResult>& results, const Vec3& origin) {
  VectorLayer layer{
      "fence_posts",
      "posts, with the arrivals nearest to each",
      GeometryType::point_z,
      vector_fields(post_fields()),
      {},
      vector_qml({SymbolKind::point, "", {{"", "", {60, 60, 60, 255}}}, 1.6, "\"post\""})};
  for (std::size_t i = 0; i < fences.size(); ++i)
    for (std::size_t p = 0; p < results[i].posts.size(); ++p) {
      VectorFeature feature;
      feature.points = {fences[i].fence.post[p] + origin};
      feature.values = values_of(
          post_fields(), {fences[i], results[i], p, results[i].posts[p], results[i].design});
      layer.features.push_back(std::move(feature));
    }
  return layer;
}

VectorLayer arrivals_layer(const std::vector<FenceCase>& fences, const FenceRunGroup& group,
                           const Vec3& origin) {
  VectorLayer layer{"fence_arrivals",
                    "where and how blocks come at the fences or pass beside them",
                    GeometryType::point_z,
                    vector_fields(verdict_fields()),
                    {},
                    vector_qml(verdict_style(SymbolKind::point, 2))};
  for (std::size_t i = 0; i < fences.size(); ++i)
    for (int r = 0; r < n_runs(group); ++r)
      for (const BlockVerdict& v : group.runs[r].at_fence[i].verdicts) {
        if (v.arrival < 0) continue;
        const FenceArrival& a = group.runs[r].at_fence[i].arrivals[v.arrival];
        VectorFeature f;
        f.points = {place_of(a, fences[i].fence) + origin};
        f.values = values_of(verdict_fields(), {fences[i].fence, group, r, v, &a});
        layer.features.push_back(std::move(f));
      }
  return layer;
}

}  // namespace

std::vector<VectorLayer> fence_layers(const std::vector<FenceCase>& fences,
                                      const std::vector<FenceResult>& results,
                                      const std::vector<FenceCase>& lines,
                                      const FenceRunGroup& group, const Vec3& origin) {
  return {whole_layer(fences, results, origin), field_layer(fences, results, origin),
          post_layer(fences, results, origin), arrivals_layer(lines, group, origin)};
}

VectorLayer dam_layer(const std::vector<DamCase>& dams, const std::vector<DamResult>& results,
                      const std::vector<Fence>& crests, const Vec3& origin) {
  struct DamRow {
    const DamCase& dam;
    const DamResult& result;
  };
  using Dam = const DamRow&;
  static const std::vector<Field<DamRow>> fields = {
      {"dam", "", "Dam", [](Dam r) -> Value { return r.dam.name; }, words},
      {"kind", "", "Dam or gallery",
       [](Dam r) -> Value { return std::string(r.dam.is_gallery ? "gallery" : "dam"); }, words},
      {"height_m", "m", "Height of the crest", [](Dam r) -> Value { return r.dam.height; }},
      {"arrivals", "", "Number of arrivals", [](Dam r) -> Value { return r.result.arriving.n; },
       whole},
      {"passed", "", "Number that passed over the crest",
       [](Dam r) -> Value { return r.result.passing.n; }, whole},
      {"energy_p95_kj", "kJ", "Kinetic energy of arrivals, 95th percentile",
       [](Dam r) -> Value { return p95(r.result.arriving.energy).value / kilo; }},
      {"energy_max_kj", "kJ", "Kinetic energy of arrivals, largest",
       [](Dam r) -> Value { return r.result.arriving.energy.largest / kilo; }},
      {"roof_energy_max_kj", "kJ", "Largest energy normal to the roof of a gallery",
       [](Dam r) -> Value {
         const std::vector<LoadCase>& cases = r.result.load_cases;
         return cases.empty() || !cases.back().load ? std::nan("")
                                                    : cases.back().load->normal_energy() / kilo;
       }},
      {"verdict", "", "Verdict", [](Dam r) -> Value { return text(r.result.verdict); }, words},
      {"verdict_text", "", "Verdict in words", [](Dam r) -> Value { return r.result.text; },
       words}};
  VectorLayer layer{"dams",
                    "crests of the dams and valley edges of the galleries, with their verdict",
                    GeometryType::line_zm,
                    vector_fields(fields),
                    {},
                    vector_qml({SymbolKind::line, "verdict", verdict_classes(), 1.4, "\"dam\""})};
  for (std::size_t i = 0; i < dams.size(); ++i) {
    VectorFeature feature;
    for (const Vec3& post : crests[i].post) feature.points.emplace_back(post + origin);
    feature.measure = crests[i].chainage;
    feature.values = values_of(fields, {dams[i], results[i]});
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

}  // namespace talus
