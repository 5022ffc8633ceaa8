// Hit trees of runs, as layers of the GeoPackage and as JSON.
#include "tools/runout/trees.hpp"

#include <algorithm>
#include <cmath>

#include "io/style.hpp"
#include "scene/stand.hpp"
#include "tools/frame/row_json.hpp"

namespace talus {
namespace {

constexpr std::size_t most_listed = 20;  // of the stems that were hit, in the JSON

std::string species_of(const TreeHitRow& row) { return known_species()[row.species].name; }

using Value = FieldValue;
constexpr FieldType words = FieldType::text, whole = FieldType::integer;
constexpr double kilo = 1e3;

const std::vector<Field<HitStem>>& stem_fields() {
  using Stem = const HitStem&;
  static const std::vector<Field<HitStem>> fields = {
      {"forest", "", "Forest", [](Stem s) -> Value { return s.forest; }, words},
      {"stem", "", "Stem", [](Stem s) -> Value { return s.first.stem; }, whole},
      {"species", "", "Species", [](Stem s) -> Value { return species_of(s.first); }, words},
      {"dbh_cm", "cm", "Diameter at breast height",
       [](Stem s) -> Value { return 100 * s.first.dbh; }},
      {"capacity_kj", "kJ", "Energy that breaks it",
       [](Stem s) -> Value { return s.first.capacity / kilo; }},
      {"fate", "", "Fate", [](Stem s) -> Value { return s.n_broken > 0 ? "broken" : "stands"; },
       words},
      {"n_runs", "", "Number of runs that hit it", [](Stem s) -> Value { return s.n_runs; }, whole},
      {"n_hits", "", "Number of hits", [](Stem s) -> Value { return s.n_hits; }, whole},
      {"n_broken", "", "Number of times broken", [](Stem s) -> Value { return s.n_broken; }, whole},
      {"largest_work_kj", "kJ", "Largest energy that a block lost to it",
       [](Stem s) -> Value { return s.largest_work / kilo; }},
      {"least_left_kj", "kJ", "Least capacity left",
       [](Stem s) -> Value { return s.least_left / kilo; }}};
  return fields;
}

VectorLayer stem_layer(const TreeSummary& trees, const Vec3& origin) {
  VectorLayer layer{"trees_hit",
                    "stems that blocks hit, over all runs",
                    GeometryType::point_z,
                    vector_fields(stem_fields()),
                    {},
                    vector_qml({SymbolKind::point,
                                "fate",
                                {{"stands", "hit, stands", {35, 132, 67, 255}},
                                 {"broken", "broken in a run", {140, 81, 10, 255}}},
                                1.6})};
  for (const HitStem& stem : trees.stems) {
    VectorFeature f;
    f.points = {stem.first.foot + origin};
    f.values = values_of(stem_fields(), stem);
    layer.features.push_back(std::move(f));
  }
  return layer;
}

struct HitOfRun {
  const std::string &run_id, &forest;
  const TreeHitRow& row;
};
const std::vector<Field<HitOfRun>>& hit_fields() {
  using Hit = const HitOfRun&;
  static const std::vector<Field<HitOfRun>> fields = {
      {"run_id", "", "Run", [](Hit h) -> Value { return h.run_id; }, words},
      {"block", "", "Block", [](Hit h) -> Value { return h.row.hit.block; }, whole},
      {"forest", "", "Forest", [](Hit h) -> Value { return h.forest; }, words},
      {"stem", "", "Stem", [](Hit h) -> Value { return h.row.stem; }, whole},
      {"species", "", "Species", [](Hit h) -> Value { return species_of(h.row); }, words},
      {"dbh_cm", "cm", "Diameter at breast height", [](Hit h) -> Value { return 100 * h.row.dbh; }},
      {"time_s", "s", "Time", [](Hit h) -> Value { return h.row.hit.time; }},
      {"height_m", "m", "Height above the foot", [](Hit h) -> Value { return h.row.hit.height; }},
      {"speed_m_s", "m/s", "Speed before",
       [](Hit h) -> Value { return h.row.hit.velocity.norm(); }},
      {"energy_before_kj", "kJ", "Kinetic energy before, with spin",
       [](Hit h) -> Value {
         return (h.row.hit.translational_energy + h.row.hit.rotational_energy) / kilo;
       }},
      {"work_kj", "kJ", "Energy that the stem took",
       [](Hit h) -> Value { return h.row.hit.work / kilo; }},
      {"energy_after_kj", "kJ", "Kinetic energy after, with spin",
       [](Hit h) -> Value { return h.row.hit.energy_after / kilo; }},
      {"capacity_kj", "kJ", "Energy that breaks the stem",
       [](Hit h) -> Value { return h.row.capacity / kilo; }},
      {"left_kj", "kJ", "Capacity left at the end",
       [](Hit h) -> Value { return h.row.left / kilo; }},
      {"broken", "", "Whether the stem broke",
       [](Hit h) -> Value { return h.row.broken_by >= 0 ? 1 : 0; }, whole}};
  return fields;
}

VectorLayer hit_layer(const std::vector<RunTrees>& runs, const std::vector<std::string>& run_ids,
                      const Vec3& origin) {
  VectorLayer layer{"tree_hits",
                    "blocks and the stems that they touched, by run",
                    GeometryType::point_z,
                    vector_fields(hit_fields()),
                    {},
                    vector_qml({SymbolKind::point, "", {{"", "", {120, 120, 120, 200}}}, 0.8})};
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const TreeHitRow& row : runs[r].hits) {
      VectorFeature f;
      f.points = {row.foot + origin};
      f.values = values_of(hit_fields(), {run_ids[r], runs[r].forests[row.forest].name, row});
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
    stems.push_back(row_json(stem_fields(), *stem));
    stems.back().update({{"x_m", at.x()}, {"y_m", at.y()}, {"z_m", at.z()}});
  }
  return {{"forests", forests}, {"n_stems_hit", trees.stems.size()}, {"stems", stems}};
}

}  // namespace talus
