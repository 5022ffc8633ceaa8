// libcore/io/library_settings_gdal.hpp
// Settings of GDAL and PROJ that would change what is read: none but ours count.
// in:    the environment, ~/.gdal/gdalrc, proj.ini
#pragma once

namespace talus {

/// Before these libraries are used, once: no setting of GDAL, PROJ and SpatiaLite in the
/// environment, in gdalrc and in proj.ini counts, but for what says where data and temporary files
/// lie and how much memory is used. With network_is_allowed() (base/network.hpp), what says how
/// files of a network are reached counts, too.
void fix_library_settings();

}  // namespace talus
