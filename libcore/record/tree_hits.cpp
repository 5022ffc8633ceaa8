// Rows of tree hits from the state of a run.
#include "record/tree_hits.hpp"

#include <algorithm>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "scene/stems.hpp"
#include "scene/worlds.hpp"

namespace talus {

std::vector<TreeHitRow> tree_hit_rows(const Scene& scene, const State& state) {
  std::vector<TreeHitRow> rows;
  for (const StemHit& hit : state.stem_hits) {
    const Stem& stem = scene.forest.stems[hit.stem];
    const Yielded& met = met_by_stem(scene, state, world_of(scene, hit.block), hit.stem);
    TreeHitRow row;
    row.forest = stem.section;
    row.stem = stem.id;
    row.species = stem.species;
    row.foot = stem.foot;
    row.dbh = 2 * stem.radius;
    row.capacity = stem.capacity;
    row.left = std::max(0.0, stem.capacity - met.work);
    row.broken_at = met.broken_at;
    row.broken_by = met.broken_by;
    row.hit = hit;
    if (met.broken_by >= 0) row.left = 0;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace talus
