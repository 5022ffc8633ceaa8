// libcore/io/raster_commands.hpp: public
// Commands of GDAL that messages give for rasters. Their output says which cells are unknown.
#pragma once

#include <string>

namespace talus {

/// Kind of the cells of a raster: decides how it is resampled.
enum class CellKind { heights, values, classes };

/// gdalwarp of `from` to a file called `to`, or otherwise where there is one: cells beyond the edge
/// of `from` are unknown. `options`: further words, "-t_srs EPSG:32632"; may be empty.
[[nodiscard]] std::string warp_command(CellKind kind, const std::string& options,
                                       const std::string& from, const std::string& to);

/// gdal_translate of `from` to a file called `to`, or otherwise where there is one.
[[nodiscard]] std::string translate_command(const std::string& options, const std::string& from,
                                            const std::string& to);

/// The command that makes metres of heights in units of `unit_m` metres. The copy is in `crs`, the
/// code of a plan; empty: in the system of `from`.
[[nodiscard]] std::string scale_command(double unit_m, const std::string& crs,
                                        const std::string& from);

/// The command that takes the ground of a laser scan as text, ground.csv.
[[nodiscard]] std::string ground_points_command(const std::string& from);

}  // namespace talus
