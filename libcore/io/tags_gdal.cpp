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

std::vector<BandTags> band_tags(const std::string& path) {
  register_gdal_drivers();
  const GdalErrors quiet;
  const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path.c_str(), GDAL_OF_READONLY));
  std::vector<BandTags> bands;
  for (int i = 1; dataset && i <= dataset->GetRasterCount(); ++i) {
    GDALRasterBand* const band = dataset->GetRasterBand(i);
    const char* const meaning = band->GetMetadataItem("long_name");
    bands.push_back(
        {band->GetDescription(), band->GetUnitType(), meaning != nullptr ? meaning : ""});
  }
  return bands;
}

}  // namespace talus
