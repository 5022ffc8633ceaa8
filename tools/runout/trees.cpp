#include "tools/runout/trees.hpp"

#include <algorithm>
#include <cmath>

#include "io/style.hpp"
#include "scene/stand.hpp"

namespace talus {
namespace {

constexpr std::size_t most_listed = 20;  // of the stems that were hit, in the JSON

FieldValue whole(std::int64_t value) { return value; }
std::string species_of(const TreeHitRow& row) { return known_species()[row.species].name; }

VectorLayer stem_layer(const TreeSummary& trees, const Vec3& origin) {
  VectorLayer layer{"trees_hit",
                    "stems that blocks hit, over all runs",
                    GeometryType::point_z,
                    {{"forest", FieldType::text},
                     {"stem", FieldType::integer},
                     {"species", FieldType::text},
                     {"dbh_cm", FieldType::real},
                     {"capacity_kj", FieldType::real},
                     {"fate", FieldType::text},
                     {"n_runs", FieldType::integer},
                     {"n_hits", FieldType::integer},
                     {"n_broken", FieldType::integer},
                     {"largest_work_kj", FieldType::real},
                     {"least_left_kj", FieldType::real}},
                    {},
                    vector_qml({SymbolKind::point,
                                "fate",
                                {{"stands", "hit, stands", {35, 132, 67, 255}},
                                 {"broken", "broken in a run", {140, 81, 10, 255}}},
                                1.6})};
  for (const HitStem& stem : trees.stems) {
    VectorFeature f;
    f.points = {stem.first.foot + origin};
    f.values = {stem.forest,
                whole(stem.first.stem),
                species_of(stem.first),
                100 * stem.first.dbh,
                stem.first.capacity / 1e3,
                std::string(stem.n_broken > 0 ? "broken" : "stands"),
                whole(stem.n_runs),
                whole(stem.n_hits),
                whole(stem.n_broken),
                stem.largest_work / 1e3,
                stem.least_left / 1e3};
    layer.features.push_back(std::move(f));
  }
  return layer;
}

VectorLayer hit_layer(const std::vector<RunTrees>& runs, const std::vector<std::string>& run_ids,
                      const Vec3& origin) {
  VectorLayer layer{"tree_hits",
                    "blocks and the stems that they touched, by run",
                    GeometryType::point_z,
                    {{"run_id", FieldType::text},
                     {"block", FieldType::integer},
                     {"forest", FieldType::text},
                     {"stem", FieldType::integer},
                     {"species", FieldType::text},
                     {"dbh_cm", FieldType::real},
                     {"time_s", FieldType::real},
                     {"height_m", FieldType::real},
                     {"speed_m_s", FieldType::real},
                     {"energy_before_kj", FieldType::real},
                     {"work_kj", FieldType::real},
                     {"energy_after_kj", FieldType::real},
                     {"capacity_kj", FieldType::real},
                     {"left_kj", FieldType::real},
                     {"broken", FieldType::integer}},
                    {},
                    vector_qml({SymbolKind::point, "", {{"", "", {120, 120, 120, 200}}}, 0.8})};
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const TreeHitRow& row : runs[r].hits) {
      VectorFeature f;
      f.points = {row.foot + origin};
      f.values = {run_ids[r],
                  whole(row.hit.block),
                  runs[r].forests[row.forest].name,
                  whole(row.stem),
                  species_of(row),
                  100 * row.dbh,
                  row.hit.time,
                  row.hit.height,
                  row.hit.velocity.norm(),
                  (row.hit.translational_energy + row.hit.rotational_energy) / 1e3,
                  row.hit.work / 1e3,
                  row.hit.energy_after / 1e3,
                  row.capacity / 1e3,
                  row.left / 1e3,
                  whole(row.broken_by >= 0 ? 1 : 0)};
      layer.features.push_back(std::move(f));
    }
  return layer;
}

}  // namespace

std::vector<VectorLayer> tree_layers(const std::vector<RunTrees>& runs,
                                     const std::vector<std::string>& run_ids, const Vec3& origin) {
  return {stem_layer(summary_of(runs), origin), hit_layer(runs, run_ids, origin)};
}

Json trees_json(const TreeSummary& trees, const Vec3& origin) {
  Json forests = Json::array(), stems = Json::array();
  for (const ForestSummary& f : trees.forests) {
    forests.push_back({{"forest", f.name},
                       {"n_runs", f.n_runs},
                       {"stems", f.stems},
                       {"hit", f.hit},
                       {"broken", f.broken},
                       {"work_kj", f.work / 1e3}});
    if (f.n_worlds > f.n_runs) forests.back()["n_rocks"] = f.n_worlds;
  }
  std::vector<const HitStem*> order;
  for (const HitStem& stem : trees.stems) order.push_back(&stem);
  std::stable_sort(order.begin(), order.end(), [](const HitStem* a, const HitStem* b) {
    return a->n_broken != b->n_broken ? a->n_broken > b->n_broken : a->n_hits > b->n_hits;
  });
  order.resize(std::min(order.size(), most_listed));
  for (const HitStem* stem : order) {
    const Vec3 at = stem->first.foot + origin;
    stems.push_back({{"forest", stem->forest},
                     {"stem", stem->first.stem},
                     {"species", species_of(stem->first)},
                     {"dbh_cm", 100 * stem->first.dbh},
                     {"x_m", at.x()},
                     {"y_m", at.y()},
                     {"z_m", at.z()},
                     {"capacity_kj", stem->first.capacity / 1e3},
                     {"n_runs", stem->n_runs},
                     {"n_hits", stem->n_hits},
                     {"n_broken", stem->n_broken},
                     {"largest_work_kj", stem->largest_work / 1e3},
                     {"least_left_kj", stem->least_left / 1e3}});
  }
  return {{"forests", forests}, {"n_stems_hit", trees.stems.size()}, {"stems", stems}};
}

}  // namespace talus
