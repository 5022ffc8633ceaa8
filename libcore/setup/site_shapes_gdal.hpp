// libcore/setup/site_shapes_gdal.hpp: public
// Where sections of a site file say that something is: points written there, and vector files, read
// themselves or as talus-import wrote them.
// in:    a site
// out:   shapes in the local coordinates of a terrain
#pragma once

#include <string>
#include <vector>

#include "base/input_log.hpp"
#include "import/request.hpp"
#include "import/vectors_gdal.hpp"
#include "io/raster_commands.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A place as a section gives it.
struct SitePlace {
  std::string section;  ///< "fence.valley", "source"
  std::string layer;    ///< of talus-import: docs/reference/formats.md#inputs
  VectorKind kind = VectorKind::areas;
  std::string file;               ///< as the section has it; empty: none
  std::vector<Vec3> points = {};  ///< written in the section, map coordinates; points are alone
  std::string points_key = {};    ///< "polygon"
  std::vector<std::string> fields = {};  ///< attributes to read of points
};

/// Where the section is in the site file.
[[nodiscard]] Where where_of_object(const Site& site, const ObjectSettings& object);

[[nodiscard]] SitePlace place_of(const SourceSettings& source);
[[nodiscard]] SitePlace place_of(const GroundSettings& ground);
[[nodiscard]] SitePlace place_of(const FenceSettings& fence);
[[nodiscard]] SitePlace place_of(const DamSettings& dam);
[[nodiscard]] SitePlace place_of(const ForestSettings& forest);
[[nodiscard]] SitePlace stems_of(const ForestSettings& forest);
[[nodiscard]] SitePlace place_of(const PlaceSettings& place);
[[nodiscard]] SitePlace boulders_of(const ObservedSettings& observed);
[[nodiscard]] SitePlace scars_of(const ObservedSettings& observed);
[[nodiscard]] SitePlace outline_of(const ObservedSettings& observed);
[[nodiscard]] SitePlace release_of(const RockfallSettings& rocks);  ///< points or lines
[[nodiscard]] SitePlace areas_of(const RockfallSettings& rocks);
/// Throws InputError for an object without a place or with several, lines without a width, points
/// without a radius.
[[nodiscard]] SitePlace place_of(const Site& site, const ObjectSettings& object);

/// All shapes on the ground of the site, in files and in the site file, to be read
/// together: the request to talus-import.
[[nodiscard]] std::vector<RequestedLayer> layers_of(const Site& site);

/// A raster that the site names.
struct SiteRaster {
  std::string key;  ///< "forest.upper.nrtrees_raster"
  std::string path;
  CellKind kind = CellKind::values;
};
[[nodiscard]] std::vector<SiteRaster> rasters_of(const Site& site);

/// The shapes in local coordinates: those written in the section first, with z as it is written.
/// Their files are told to the log, with the layer, number and area of the shapes taken. Throws
/// InputError as read_vectors(), and where Site::inputs is older than the files that the site
/// names.
[[nodiscard]] VectorShapes local_shapes(InputLog& log, const Site& site, const Trn& ground,
                                        const SitePlace& place);

/// The same in plan.
[[nodiscard]] std::vector<std::vector<Vec2>> shapes_in_plan(InputLog& log, const Site& site,
                                                            const Trn& ground,
                                                            const SitePlace& place);

/// Points of the site file (map coordinates in the CRS of [site]) as local ones; z NaN stays NaN.
/// `key` of `section` is where they are written. Throws InputError as read_vectors().
[[nodiscard]] std::vector<Vec3> local_points(InputLog& log, const Site& site, const Trn& ground,
                                             std::vector<Vec3> points, const std::string& section,
                                             const std::string& key);

}  // namespace talus
