// tools/frame/object_files.hpp
// Names of objects as names of files.
#pragma once

#include "site/site.hpp"

namespace talus {

/// A raster is made of each object: throws InputError for two names that differ in signs alone,
/// which would be one file, and for one that is too long.
void check_object_files(const Site& site);

}  // namespace talus
