#include "tools/fence/layers.hpp"

#include <cmath>

#include "base/units.hpp"
#include "io/style.hpp"
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

void add_part(std::vector<FieldValue>& values, const FencePartSummary& p) {
  values.insert(
      values.end(),
      {static_cast<std::int64_t>(p.n), p.per_run, p.energy.percentile[place_of_p95].value / 1e3,
       p.energy.percentile[place_of_p95].upper / 1e3, p.energy.largest / 1e3,
       p.top.percentile[place_of_p95].value, p.top.percentile[place_of_p95].upper, p.top.largest,
       p.speed.percentile[place_of_p95].value, p.speed.largest, p.mean_angle / degree,
       p.window_energy / 1e3});
}

std::vector<VectorField> part_fields(std::vector<VectorField> fields) {
  fields.push_back({"n", FieldType::integer});
  for (const char* name : {"per_run", "energy_p95_kj", "energy_p95_hi_kj", "energy_max_kj",
                           "top_p95_m", "top_p95_hi_m", "top_max_m", "speed_p95_m_s",
                           "speed_max_m_s", "angle_to_normal_deg", "energy_in_one_second_kj"})
    fields.push_back({name, FieldType::real});
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
          {"nothing came", "not judged: nothing came", {190, 190, 190, 255}}};
}

// The verdict of each fence as a whole: the one that terminal and report give.
VectorLayer whole_layer(const std::vector<FenceCase>& fences,
                        const std::vector<FenceResult>& results, const Vec3& origin) {
  VectorLayer layer{"fences",
                    "the fences with the verdict of their design check",
                    GeometryType::line_zm,
                    {{"fence", FieldType::text}, {"arrivals", FieldType::integer}},
                    {},
                    vector_qml({SymbolKind::line, "verdict", verdict_classes(), 1.4, "\"fence\""})};
  for (const char* name : {"design_energy_kj", "required_capacity_kj", "required_height_m"})
    layer.fields.push_back({name, FieldType::real});
  for (const char* name : {"smallest_class", "basis", "verdict", "verdict_text"})
    layer.fields.push_back({name, FieldType::text});
  layer.fields.push_back({"pass", FieldType::integer});
  for (std::size_t i = 0; i < fences.size(); ++i) {
    const DesignResult& r = results[i].design;
    VectorFeature feature;
    for (const Vec3& post : fences[i].fence.post) feature.points.emplace_back(post + origin);
    feature.measure = fences[i].fence.chainage;
    feature.values = {fences[i].fence.name,
                      static_cast<std::int64_t>(r.n_arrivals),
                      r.design_energy / 1e3,
                      r.required_capacity / 1e3,
                      r.required_height,
                      r.smallest_class,
                      basis_text(results[i]),
                      std::string(text(r.verdict)),
                      text(r),
                      pass_field(r)};
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer field_layer(const std::vector<FenceCase>& fences,
                        const std::vector<FenceResult>& results, const Vec3& origin) {
  VectorLayer layer{"fence_fields",
                    "fields of the fences, each judged by the arrivals at it alone",
                    GeometryType::line_zm,
                    part_fields({{"fence", FieldType::text}, {"field", FieldType::integer}}),
                    {},
                    vector_qml({SymbolKind::line, "verdict", verdict_classes(), 1.2})};
  for (const char* name : {"storage_m3", "required_capacity_kj", "required_height_m"})
    layer.fields.push_back({name, FieldType::real});
  for (const char* name : {"smallest_class", "governs"})
    layer.fields.push_back({name, FieldType::text});
  layer.fields.push_back({"pass", FieldType::integer});
  for (const char* name : {"verdict", "verdict_text"})
    layer.fields.push_back({name, FieldType::text});
  for (std::size_t i = 0; i < fences.size(); ++i)
    for (std::size_t f = 0; f < results[i].fields.size(); ++f) {
      const FieldResult& r = results[i].fields[f];
      const Fence& fence = fences[i].fence;
      VectorFeature feature;
      feature.points = {fence.post[f] + origin, fence.post[f + 1] + origin};
      feature.measure = {fence.chainage[f], fence.chainage[f + 1]};
      feature.values = {fence.name, static_cast<std::int64_t>(f)};
      add_part(feature.values, r.part);
      feature.values.insert(feature.values.end(),
                            {r.storage, r.design.required_capacity / 1e3, r.design.required_height,
                             r.design.smallest_class, r.design.governs, pass_field(r.design),
                             std::string(text(r.design.verdict)), text(r.design)});
      layer.features.push_back(std::move(feature));
    }
  return layer;
}

VectorLayer post_layer(const std::vector<FenceCase>& fences,
                       const std::vector<FenceResult>& results, const Vec3& origin) {
  VectorLayer layer{
      "fence_posts",
      "posts, with the arrivals nearest to each",
      GeometryType::point_z,
      part_fields({{"fence", FieldType::text}, {"post", FieldType::integer}}),
      {},
      vector_qml({SymbolKind::point, "", {{"", "", {60, 60, 60, 255}}}, 1.6, "\"post\""})};
  for (std::size_t i = 0; i < fences.size(); ++i)
    for (std::size_t p = 0; p < results[i].posts.size(); ++p) {
      VectorFeature feature;
      feature.points = {fences[i].fence.post[p] + origin};
      feature.values = {fences[i].fence.name, static_cast<std::int64_t>(p)};
      add_part(feature.values, results[i].posts[p]);
      layer.features.push_back(std::move(feature));
    }
  return layer;
}

VectorLayer arrivals_layer(const std::vector<FenceCase>& fences, const FenceRunGroup& group,
                           const Vec3& origin) {
  VectorLayer layer{"fence_arrivals",
                    "where and how blocks come at the fences or pass beside them",
                    GeometryType::point_z,
                    {{"fence", FieldType::text},
                     {"run_id", FieldType::text},
                     {"block", FieldType::integer},
                     {"verdict", FieldType::text},
                     {"recorded_at", FieldType::text}},
                    {},
                    vector_qml(verdict_style(SymbolKind::point, 2))};
  for (const char* name : {"time_s", "chainage_m", "speed_m_s", "angle_to_normal_deg", "spin_rad_s",
                           "translational_energy_kj", "rotational_energy_kj", "centroid_height_m",
                           "top_height_m", "bottom_height_m", "volume_m3"})
    layer.fields.push_back({name, FieldType::real});
  for (std::size_t i = 0; i < fences.size(); ++i)
    for (int r = 0; r < n_runs(group); ++r)
      for (const BlockVerdict& v : group.runs[r].at_fence[i].verdicts) {
        if (v.arrival < 0) continue;
        const FenceArrival& a = group.runs[r].at_fence[i].arrivals[v.arrival];
        VectorFeature f;
        f.points = {place_of(a, fences[i].fence) + origin};
        f.values = {fences[i].fence.name,
                    group.members[r].info.run_id,
                    static_cast<std::int64_t>(a.block),
                    std::string(text(v.verdict)),
                    std::string(recorded_at(a)),
                    a.time,
                    a.chainage,
                    a.speed,
                    a.beside ? std::nan("") : a.angle / degree,
                    a.spin,
                    a.translation / 1e3,
                    a.rotation / 1e3,
                    a.centroid,
                    a.top,
                    a.bottom,
                    a.volume};
        layer.features.push_back(std::move(f));
      }
  return layer;
}

}  // namespace

std::vector<VectorLayer> fence_layers(const std::vector<FenceCase>& fences,
                                      const std::vector<FenceResult>& results,
                                      const FenceRunGroup& group, const Vec3& origin) {
  return {whole_layer(fences, results, origin), field_layer(fences, results, origin),
          post_layer(fences, results, origin), arrivals_layer(fences, group, origin)};
}

}  // namespace talus
