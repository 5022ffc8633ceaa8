// libcore/base/file_paths.hpp: public
// Files as they are named on a command line: GDAL's virtual ones, those kept beside another, and
// the one spelling of a path that two names can be compared by.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace talus {

/// A virtual path of GDAL (/vsi...), which the file system does not know.
[[nodiscard]] bool is_virtual(const std::string& path);

/// The file that GDAL's name for a part of it speaks of: map.gpkg of GPKG:map.gpkg:dgm, scene.nc of
/// NETCDF:"scene.nc":z. Any other path as it is.
[[nodiscard]] std::string file_behind(const std::string& path);

/// The file of a source's name: "map.gpkg" of "map.gpkg|layername=a", "map.zip" of
/// "/vsizip/map.zip/a.shp".
[[nodiscard]] std::string file_of(const std::string& source);

/// The rest of a source's name after the file, as it is written; may be empty.
[[nodiscard]] std::string part_named(const std::string& source);

/// Absolute and without links, as far as it exists; a virtual path as it is.
[[nodiscard]] std::string absolute_path(const std::string& path);

/// A name of the site file as part of the name of a file: other signs than letters, digits, - and _
/// become _.
[[nodiscard]] std::string file_word(const std::string& name);

/// In small letters, with the point: ".tif"; empty: there is none.
[[nodiscard]] std::string extension_of(const std::string& path);

/// "." for a name alone.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& path);

/// Files that a format keeps beside the named one, whether or not they exist: of a Shapefile its
/// index, attributes, CRS and encoding; of other formats none.
[[nodiscard]] std::vector<std::string> sidecars_of(const std::string& path);

}  // namespace talus
