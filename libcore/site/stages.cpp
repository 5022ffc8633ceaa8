// Sections and keys of the site file that each stage of the pipeline reads.
#include "site/stages.hpp"

#include <algorithm>

namespace talus {
namespace {

// Sections and keys that a stage reads. An entry is "section", "section.key" or, for a key that the
// stage does not read, "-section.key"; a section means all of its names ("joints" for
// [joints.J1]).
struct Stage {
  std::string name;
  std::vector<std::string> reads;
};

const std::vector<Stage>& stages() {
  static const std::vector<Stage> list = {
      {"import",
       {"site.crs",
        "source.polygon",
        "ground.polygon",
        "fence.line",
        "forest.polygon",
        "object.polygon",
        "object.line",
        "object.position_m",
        "place.polygon",
        "terrain.contours",
        "terrain.elevation_field",
        "terrain.breaklines",
        "terrain.spots",
        "terrain.boundary",
        "terrain.dem",
        "terrain.ground_raster",
        "source.polygon_file",
        "source.raster",
        "water.raster",
        "ground.polygon_file",
        "fence.file",
        "dam.line",
        "dam.file",
        "forest.active",
        "forest.polygon_file",
        "forest.stems_file",
        "forest.nrtrees_raster",
        "forest.dbhmean_raster",
        "forest.dbhstd_raster",
        "forest.conif_percent_raster",
        "rockfall.release_file",
        "rockfall.release_spacing_m",
        "rockfall.polygon",
        "rockfall.polygon_file",
        "rockfall.rockdensity_raster",
        "rockfall.d1_raster",
        "rockfall.d2_raster",
        "rockfall.d3_raster",
        "rockfall.blshape_raster",
        "object.file",
        "object.width_m",
        "object.radius_m",
        "place.polygon_file",
        "observed"}},
      {"tin",
       {"terrain.contours", "terrain.elevation_field", "terrain.breaklines", "terrain.spots",
        "terrain.boundary", "terrain.flat"}},
      {"trn",
       {"site.crs", "terrain.dem", "terrain.cell_size_m", "terrain.window_m", "dam",
        "-dam.capacity_kj"}},
      {"blocks", {"site.crs", "source", "joints", "blocks", "rockfall", "material"}},
      {"rock", {"site.crs", "source", "joints", "blocks", "rockfall", "material", "uncertainty"}},
      {"run",
       {"site.name",
        "site.crs",
        "terrain.ground_raster",
        "material",
        "joints",
        "ground",
        "solver",
        "fence",
        "dam",
        "-dam.capacity_kj",
        "forest",
        "fragmentation",
        "base_motion",
        "water",
        "output",
        "object",
        "-object.presence",
        "-object.vulnerability",
        "-object.persons_per_day",
        "fence_search",
        "-fence_search.share",
        "-fence_search.heights_m",
        "-fence_search.classes_kj",
        "-fence_search.prices_per_m",
        "-fence_search.price_per_m2",
        "-fence_search.code",
        "-fence_search.max_length_m",
        "-fence_search.two_fences",
        "-solver.seed",
        "-solver.n_runs",
        "-output.checkpoint_interval_s",
        "uncertainty",
        "-uncertainty.max_failed_share",
        "-uncertainty.sample"}},
      {"stability",
       {"site.crs", "terrain.ground_raster", "material", "joints", "ground", "solver",
        "-solver.seed", "base_motion", "water", "uncertainty", "-uncertainty.max_failed_share",
        "-uncertainty.sample"}},
      {"fence", {"site.name", "site.crs", "fence", "dam"}},
      {"place", {"site.crs", "place"}},
      {"calibrate", {"site.crs", "observed"}},
      {"hazard", {"site.name", "site.crs", "hazard"}},
      {"trace", {"site.name", "site.crs", "object", "dam", "-dam.capacity_kj", "hazard"}},
      {"search",
       {"site.name", "site.crs", "object", "-object.presence", "-object.vulnerability",
        "-object.persons_per_day", "dam", "-dam.capacity_kj", "fence_search", "hazard"}},
  };
  return list;
}

// "joints" for "joints.J1"
std::string kind_of(const std::string& section) { return section.substr(0, section.find('.')); }

}  // namespace

const std::vector<std::string>& stage_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Stage& stage : stages()) list.push_back(stage.name);
    return list;
  }();
  return names;
}

bool stage_reads(const std::string& stage, const EffectiveValue& value) {
  const auto found = std::find_if(stages().begin(), stages().end(),
                                  [&stage](const Stage& s) { return s.name == stage; });
  const auto has = [&found](const std::string& entry) {
    return std::find(found->reads.begin(), found->reads.end(), entry) != found->reads.end();
  };
  const std::string kind = kind_of(value.section), key = kind + "." + value.key;
  return (has(kind) || has(key)) && !has("-" + key);
}

}  // namespace talus
