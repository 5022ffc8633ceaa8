// Tables of the layers that define sections of the site file.
#include "site/site_layers.hpp"

namespace talus {

const std::vector<SiteLayer>& site_layers() {
  using enum SiteLayer::Shape;
  const auto attribute = [](const char* name, const char* type, const char* range,
                            const char* help) {
    return KeyDescription{"observed.NAME", name, type, "", range, help};
  };
  const KeyDescription date = attribute("date", "text", "", "when it came to be there");
  static const std::vector<SiteLayer> layers = {
      {"release_points",
       "rockfall",
       points,
       "release_",
       "Release points",
       {"shape", "volume_m3", "material", "height_above_ground_m", "rocks", "frequency_per_a"}},
      {"release_areas",
       "rockfall",
       areas,
       "polygon_",
       "Release areas",
       {"shape", "volume_m3", "material", "release_spacing_m", "min_slope_deg", "rocks",
        "frequency_per_a"}},
      {"object_points", "object", points, "", "Objects: points", {"kind", "radius_m"}},
      {"fences",
       "fence",
       lines,
       "",
       "Fences",
       {"active", "height_m", "capacity_kj", "max_deflection_m", "post_spacing_m", "cor",
        "friction_deg"}},
      {"dams",
       "dam",
       lines,
       "",
       "Dams",
       {"kind", "active", "height_m", "crest_width_m", "slopes_deg", "ditch_m", "capacity_kj"}},
      {"object_lines", "object", lines, "", "Objects: lines", {"kind", "width_m"}},
      {"objects", "object", areas, "", "Objects", {"kind"}},
      {"observed_boulders",
       "observed",
       points,
       "boulders_",
       "Observed: boulders",
       {},
       {attribute("volume_m3", "number", "above 0", "volume"), date,
        attribute("start_x_m", "number", "", "x of its start in the system of the site file"),
        attribute("start_y_m", "number", "", "y of its start in the system of the site file")}},
      {"observed_scars",
       "observed",
       points,
       "scars_",
       "Observed: scars",
       {},
       {attribute("height_m", "number", "at least 0", "height above the ground"), date}},
      {"observed_outlines", "observed", areas, "outline_", "Observed: outlines", {}, {date}},
      {"places", "place", areas, "polygon_", "Places", {"half_width"}},
      {"source", "source", areas, "polygon_", "Source", {"failure_surface", "depth_m"}},
      {"forest",
       "forest",
       areas,
       "polygon_",
       "Forest",
       {"active", "stems_per_ha", "dbh_mean_cm", "dbh_std_cm", "conifer_share", "height_m"}},
      {"grounds",
       "ground",
       areas,
       "polygon_",
       "Grounds",
       {"soil", "friction_deg", "cor", "rolling_resistance", "bearing_kpa", "drag_1_m"}}};
  return layers;
}

std::vector<std::string> attributes_of(const std::string& layer) {
  std::vector<std::string> names;
  for (const SiteLayer& known : site_layers())
    if (known.name == layer)
      for (const KeyDescription& attribute : known.attributes) names.push_back(attribute.key);
  return names;
}

bool has_names(const SiteLayer& layer) { return layer.section != "source"; }

}  // namespace talus
