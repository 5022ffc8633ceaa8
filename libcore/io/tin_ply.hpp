// libcore/io/tin_ply.hpp: public
// TIN as binary PLY: written by talus-tin, read by talus-trn; opens in MeshLab, ParaView and as a
// mesh layer of QGIS. Coordinates in the file are those of the map (double), so that a viewer sets
// it in its place; the CRS and the origin are in comments:
//   comment crs EPSG:code             for viewers, when the WKT ends with a code of its own
//   comment crs_wkt PROJCRS["..."]    the WKT in lines of 400 bytes; left out without a CRS
//   comment origin_m X Y Z            map coordinates of the local zero used while computing
//   comment heights_judged SHA256     of all bytes behind the header: the heights were judged
//   comment doubts_accepted WORDS     places that the user accepted, in lines of 400 bytes
#pragma once

#include <string>
#include <string_view>

#include "terrain/tin.hpp"

namespace talus {

/// Lines of a PLY header that say the CRS, as above; "" without one.
[[nodiscard]] std::string crs_comments(const std::string& crs_wkt);

/// Writes binary little-endian PLY: vertices x y z (double), faces as lists of three (uchar, int).
/// The file says that its heights were judged, whatever `is_judged` is. Throws InputError when it
/// cannot be written.
void write_tin(const std::string& path, const Tin& tin);

/// Reads a TIN written by write_tin, or any PLY of triangles (ply.hpp). Clockwise triangles are
/// turned. Without an origin in the file the lowest corner, floored to 100 m, is
/// taken. `is_judged` holds where the file has the digest of its own data; else no doubts count as
/// accepted. Throws InputError, with the expectation, for anything else, a truncated or a lying
/// file.
[[nodiscard]] Tin read_tin(const std::string& path);

/// The same from memory; `source` names it in messages.
[[nodiscard]] Tin parse_tin(std::string_view bytes, const std::string& source);

}  // namespace talus
