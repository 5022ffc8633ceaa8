// Table of keys that a release no longer reads, and their replacements.
#include "site/gone_keys.hpp"

namespace talus {
namespace {

struct GoneKey {
  const char *section, *key, *instead;
};

constexpr GoneKey gone_keys[] = {
    {"solver", "shear_stiffness_ratio",
     "friction_deg of grounds and materials, which bounds shear"},
    {"solver", "max_passes", "time_step_s = SECONDS, smaller, where steps do not converge"},
    {"solver", "min_time_step_s", "time_step_s = SECONDS"},
    {"solver", "max_time_step_s", "time_step_s = SECONDS"},
    {"solver", "rolling_scatter", "a section [uncertainty.NAME] with keys and apply = \"factor\""},
    {"solver", "cor", "cor in [material.NAME] and [ground.NAME]"},
    {"terrain", "layer", R"(contours = "FILE|layername=LAYER")"},
    {"terrain", "where", R"(contours = "FILE|subset=FILTER")"},
    {"terrain", "breaklines_layer", R"(breaklines = "FILE|layername=LAYER")"},
    {"terrain", "breaklines_where", R"(breaklines = "FILE|subset=FILTER")"},
    {"terrain", "breaklines_elevation_field", R"(elevation_field = "breaklines=FIELD")"},
    {"terrain", "spots_elevation_field", R"(elevation_field = "spots=FIELD")"},
    {"terrain", "spots_layer", R"(spots = "FILE|layername=LAYER")"},
    {"terrain", "spots_where", R"(spots = "FILE|subset=FILTER")"},
    {"terrain", "boundary_layer", R"(boundary = "FILE|layername=LAYER")"},
    {"terrain", "boundary_where", R"(boundary = "FILE|subset=FILTER")"},
    {"source", "polygon_layer", R"(polygon_file = "FILE|layername=LAYER")"},
    {"source", "polygon_where", R"(polygon_file = "FILE|subset=FILTER")"},
    {"ground", "polygon_layer", R"(polygon_file = "FILE|layername=LAYER")"},
    {"ground", "polygon_where", R"(polygon_file = "FILE|subset=FILTER")"},
    {"blocks", "release_file", "release_file in [rockfall.NAME]"},
    {"blocks", "release_layer", "release_file = \"FILE|layername=LAYER\" in [rockfall.NAME]"},
    {"blocks", "release_where", "release_file = \"FILE|subset=FILTER\" in [rockfall.NAME]"},
    {"blocks", "release_spacing_m", "release_spacing_m in [rockfall.NAME]"},
    {"blocks", "release_grid", "polygon or polygon_file in [rockfall.NAME], without [source]"},
    {"blocks", "n_per_point", "rocks in [rockfall.NAME]"},
    {"blocks", "frequency_per_a", "frequency_per_a of the whole source in [rockfall.NAME]"},
    {"blocks", "frequency_per_m2_a", "frequency_per_m2_a in [rockfall.NAME]"},
    {"output", "strain", "strain = \"on\" in [solver], which records them, too"},
    {"blocks", "n_sides", "nothing: a prism has six sides; a file holds any other"},
    {"blocks", "y_up", "roll_deg = 90"},
    {"blocks", "in_place", "nothing: a mesh without position_m has map coordinates"},
    {"fence", "line_file", R"(file = "FILE")"},
    {"fence", "line_layer", R"(file = "FILE|layername=LAYER")"},
    {"fence", "line_where", R"(file = "FILE|subset=FILTER")"},
    {"forest", "polygon_layer", R"(polygon_file = "FILE|layername=LAYER")"},
    {"forest", "polygon_where", R"(polygon_file = "FILE|subset=FILTER")"},
    {"forest", "stems_layer", R"(stems_file = "FILE|layername=LAYER")"},
    {"forest", "fe_conifer", "the species of each stem in stems_file"},
    {"forest", "fe_broadleaf", "the species of each stem in stems_file"},
    {"forest", "deflection_m", "nothing: a stem takes its energy over 0.5 m"},
    {"ground", "spin_resistance", "rolling_resistance, which holds for pivoting too"},
    {"forest", "stems_where", R"(stems_file = "FILE|subset=FILTER")"},
    {"place", "polygon_layer", R"(polygon_file = "FILE|layername=LAYER")"},
    {"place", "polygon_where", R"(polygon_file = "FILE|subset=FILTER")"},
    {"joints", "declination_deg", "it in [joints], for all sections"},
    {"joints", "convergence_deg", "it in [joints], for all sections"},
    {"joints", "measured_notation", "the names of the columns in the first line of the list"},
    {"hazard", "mode", "failure_probability in the classes of masses that may fail once"},
    {"hazard", "split", "split in a copy of the recipe, and its path as recipe"},
    {"hazard", "by_weights", "nothing: a class without a frequency takes that of [rockfall.*]"},
    {"object", "layer", R"(file = "FILE|layername=LAYER")"},
    {"object", "where", R"(file = "FILE|subset=FILTER")"},
};

}  // namespace

std::string written_instead(const std::string& section, std::string_view key) {
  for (const GoneKey& gone : gone_keys)
    if (section.substr(0, section.find('.')) == gone.section && key == gone.key)
      return gone.instead;
  return "";
}

}  // namespace talus
