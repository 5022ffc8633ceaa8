// Commands of GDAL that messages give for rasters.
#include "io/raster_commands.hpp"

#include <filesystem>
#include <system_error>

#include "base/source_path.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

std::string with_blank(const std::string& options) {
  return options.empty() ? std::string() : options + " ";
}

// A name other than that of the file that is read, and of a file that is there: the result of
// another such command.
std::string other_name(const std::string& from, std::string to) {
  std::error_code error;
  while (std::filesystem::path(from).filename() == to || std::filesystem::exists(to, error))
    to = "again_" + to;
  return to;
}

}  // namespace

std::string warp_command(CellKind kind, const std::string& options, const std::string& from,
                         const std::string& to) {
  const char* const unknown = kind == CellKind::heights  ? "-r bilinear -ot Float32 -dstnodata nan "
                              : kind == CellKind::values ? "-r near -ot Float32 -dstnodata nan "
                                                         : "-r near -novshift -ot Int32 "
                                                           "-dstnodata -2147483648 ";
  return "gdalwarp " + (unknown + with_blank(options)) + command_words(from) + " " +
         other_name(from, to);
}

std::string translate_command(const std::string& options, const std::string& from,
                              const std::string& to) {
  return "gdal_translate " + with_blank(options) + command_words(from) + " " + other_name(from, to);
}

std::string scale_command(double unit_m, const std::string& crs, const std::string& from) {
  return translate_command("-ot Float64 -scale 0 10000 0 " + text(10000 * unit_m, 12) +
                               (crs.empty() ? "" : " -a_srs " + crs),
                           from, "metres.tif");
}

std::string ground_points_command(const std::string& from) {
  return "with PDAL, of which Debian 12 has no package (conda-forge has): pdal translate " +
         command_words(from) +
         " ground.csv -f filters.range --filters.range.limits=\"Classification[2:2]\" "
         "--writers.text.order=X,Y,Z --writers.text.keep_unspecified=false";
}

}  // namespace talus
