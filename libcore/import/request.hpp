// libcore/import/request.hpp: public
// A request to the import: the layers of one job, the purpose of each, and the statements of the
// user on them.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

namespace talus {

/// A vector source: "map.gpkg|layername=index,between|subset=ELEV > 900", or an archive. Layers are
/// parted by commas, with * and ? for any letters; without them the only one with fitting
/// geometries is taken. Of a DXF drawing they are the layers of the drawing.
struct LayerRef {
  std::string path;
  /// Empty: Z where it tells heights apart, else a field by name. "Z", or "geometry.Z" and
  /// "field.Z" where a field has that name.
  std::string elevation_field;
  double unit_m = 0;  ///< metres in one unit of its coordinates; 0: metres, or as a drawing says
};

/// The purpose of a layer: a part of the ground, reference points, or objects on the ground.
enum class InputRole {
  contours,
  points,  ///< of the ground, in place of contours
  labels,  ///< texts beside the contours that say their heights
  breaklines,
  spots,
  boundary,
  reference,
  site_areas,
  site_lines,
  site_points
};

struct RequestedLayer {
  InputRole role;
  LayerRef ref;
  std::vector<std::string> fields = {};  ///< attributes to read of site_points
  // Of objects on the ground, as talus-import writes them; the parts of the ground have none.
  std::string layer = {};    ///< "fences"
  std::string section = {};  ///< of the site file, "fence.valley"
  std::string file = {};     ///< as the section has it
  std::string digest = {};   ///< of the data set; empty: not known
  // Of points that are written in the site file, in place of `ref`:
  std::vector<Vec3> points = {};  ///< a line, a ring, or single points
  std::string crs = {};           ///< WKT; empty: that of the frame
  Where where = {};               ///< in the site file
};

/// The user's statements on the systems of a ground that its file lacks, or names otherwise.
struct SystemsByUser {
  bool crs_given = false;  ///< `crs` replaces a missing CRS, one that says no heights, or one that
                           ///< cannot be true; refused when the file has another one
  std::string crs;         ///< WKT; empty: local metres, no place on the map
  std::string t_srs;       ///< WKT; not empty: reproject to it in plan; heights stay, and so does
                           ///< the system that they are in
  std::string vertical_crs;  ///< system of heights that do not name one: WKT of a vertical system,
                             ///< or ellipsoidal_heights
  std::string t_vertical;    ///< WKT; not empty: take all heights to this vertical system
  bool accept_ballpark = false;  ///< reproject though nothing is known of the datum
};

struct InputsRequest : SystemsByUser {
  std::vector<RequestedLayer> layers;
  /// Metres in one unit of all elevations read; 0: the unit of the source, else height_unit_m().
  double elevation_unit_m = 0;
  /// There is a terrain already: `frame` is its system, WKT. Without it the first layer, contours
  /// or points, is the ground, and the frame is its system, or t_srs.
  bool has_frame = false;
  std::string frame;         ///< empty: local metres
  bool is_measured = false;  ///< say how large the numbers of each layer are
  std::string seal;          ///< of the ground that talus-import wrote; empty: it did not
};

}  // namespace talus
