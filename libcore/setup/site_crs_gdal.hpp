// libcore/setup/site_crs_gdal.hpp: public
// The coordinate system of the site file, looked at before anything is computed: it is used only
// where the file itself holds coordinates, and a misspelt one would else go unseen until then.
#pragma once

#include "io/crs_gdal.hpp"
#include "site/site.hpp"

namespace talus {

/// Throws InputError when `crs` of [site] is given and names no coordinate system.
inline void check_site_crs(const Site& site) {
  if (!site.info.crs.empty())
    (void)crs_from_user(site.info.crs, where_of(site, "site.crs").text() + ": crs");
}

}  // namespace talus
