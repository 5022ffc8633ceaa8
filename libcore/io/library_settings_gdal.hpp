// libcore/io/library_settings_gdal.hpp
// Settings of GDAL and PROJ that would change the data read: only ours count.
// in:    the environment, ~/.gdal/gdalrc, proj.ini
#pragma once

namespace talus {

/// Before these libraries are used, once: no setting of GDAL, PROJ and SpatiaLite in the
/// environment, in gdalrc and in proj.ini counts, but for the places of data and temporary files
/// and the use of memory. With network_is_allowed() (base/network.hpp), settings for access to
/// files of a network count, too.
void fix_library_settings();

}  // namespace talus
