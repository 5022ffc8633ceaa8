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

}  // namespace talus
