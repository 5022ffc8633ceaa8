// tools/hazard/filing.hpp
// A hazard map as an authority files it: areas of intensity, energy and class with who answers for
// them, by the terms of a data model. Page: docs/guide/filing.md
// in:    layers intensity, class and ke_T* of cells; [hazard] author, date and namespace
// out:   layers of a GeoPackage whose topology was checked
// refs:  Hazard_Mapping_LV95_V1_2 (BAFU, identifier 166.1, 2017-06-23); INSPIRE Natural Risk Zones,
//        HazardArea
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "io/geopackage_gdal.hpp"
#include "post/hazard/hazard_maps.hpp"
#include "site/site.hpp"

namespace talus {

struct Filing {
  std::vector<VectorLayer> layers;
  Json result;
  std::string words;  ///< of the summary
};
/// `known`: cells with ground, whose outline is the perimeter. Throws InputError for `path` where
/// the topology is not sound.
[[nodiscard]] Filing filing_of(const Site& site, const HazardSources& sources,
                               const std::vector<MapLayer>& layers, const PassageGrid& grid,
                               const std::vector<bool>& known, const Vec3& origin,
                               const std::string& path);

}  // namespace talus
