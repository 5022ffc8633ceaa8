// libcore/import/tin_files_gdal.hpp: public
// TINs of other programs: faces of CAD drawings (DXF), LandXML, OBJ, PLY.
// in:    a file
// out:   a TIN, its CRS if the file names one; notes on features passed over
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/layer_reading.hpp"
#include "import/request.hpp"
#include "terrain/tin.hpp"

namespace talus {

/// By name or first bytes: a PLY, a LandXML, an OBJ, or a drawing (DXF). A raster is none.
[[nodiscard]] bool is_tin_file(const std::string& source);

struct TinFile {
  Tin tin;
  std::vector<std::string> notes;  ///< on features taken and passed over
  std::vector<Doubt> doubts;       ///< a header that says inches
  LayerReading taken;              ///< of a drawing; without a file: it is none
};

/// Faces of a drawing: 3DFACE and meshes of its only layer with faces, or of those that are chosen;
/// a face of four corners is two triangles. LandXML: the only surface, or that of the layer's name,
/// without its invisible faces. OBJ: all faces, z up, cut into fans; it says no unit. Other units
/// than metres are refused unless they are said (`unit_m`, which scales plan and heights).
/// Triangles without an area in plan are left out and counted. Throws InputError, also for layers
/// or a unit of a file that has none.
[[nodiscard]] TinFile read_tin_file(const LayerRef& choice);

/// The CRS of a TIN, WKT, or the user's for one without, or for one in feet that `choice`
/// scales to metres; empty: local metres. Throws InputError where it cannot be computed in, or
/// coordinates cannot be in it.
[[nodiscard]] std::string crs_of_tin(const Tin& tin, const SystemsByUser& said,
                                     const LayerRef& choice, ImportReading& reading);

/// Edges at which triangles lie over one another: more than two meet, or both on one side.
struct FoldedEdges {
  std::int64_t n = 0;
  Vec3 first = Vec3::Zero();  ///< middle of the first, relative to the TIN's origin [m]
};
[[nodiscard]] FoldedEdges find_folded_edges(const Tin& tin);

}  // namespace talus
