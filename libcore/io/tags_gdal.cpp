// Tags of rasters and GeoPackages, such as RUN_ID.
#include "io/tags_gdal.hpp"

#include <gdal_priv.h>

#include <memory>

#include "io/errors_gdal.hpp"

namespace talus {

std::string tag_of(const std::string& path, const std::string& name) {
  register_gdal_drivers();
  const GdalErrors quiet;
  const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path.c_str(), GDAL_OF_READONLY));
  const char* const value = dataset ? dataset->GetMetadataItem(name.c_str()) : nullptr;
  return value != nullptr ? value : "";
}

RasterTags raster_tags(const std::string& path) {
  register_gdal_drivers();
  const GdalErrors quiet;
  const std::unique_ptr<GDALDataset> dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  RasterTags tags;
  if (!dataset) return tags;
  if (const char* shown = dataset->GetMetadataItem("SHOWN_BAND")) tags.shown = shown;
  for (int i = 1; i <= dataset->GetRasterCount(); ++i) {
    GDALRasterBand* const band = dataset->GetRasterBand(i);
    const char* const meaning = band->GetMetadataItem("long_name");
    tags.bands.push_back(
        {band->GetDescription(), band->GetUnitType(), meaning != nullptr ? meaning : ""});
  }
  return tags;
}

}  // namespace talus
