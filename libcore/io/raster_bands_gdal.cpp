#include "io/raster_bands_gdal.hpp"

#include <gdal_priv.h>

#include <cstring>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

bool is_alpha(GDALDataset& dataset, int band) {
  return dataset.GetRasterBand(band)->GetColorInterpretation() == GCI_AlphaBand;
}

std::vector<std::string> subdatasets(GDALDataset& dataset) {
  std::vector<std::string> names;
  for (char** entry = dataset.GetMetadata("SUBDATASETS"); entry != nullptr && *entry != nullptr;
       ++entry) {
    const char* const equals = std::strchr(*entry, '=');
    if (equals != nullptr &&
        std::string(static_cast<const char*>(*entry), equals).ends_with("_NAME"))
      names.emplace_back(equals + 1);
  }
  return names;
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  std::string words;
  for (std::size_t i = 0; i < names.size() && i < most; ++i)
    words += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > most) words += " and " + std::to_string(names.size() - most) + " more";
  return words;
}

}  // namespace

void refuse_several_rasters(GDALDataset& dataset, const std::string& path) {
  const std::vector<std::string> names = subdatasets(dataset);
  if (names.empty() || (names.size() == 1 && dataset.GetRasterCount() > 0)) return;
  throw InputError({path},
                   "holds " + counted(static_cast<int>(names.size()), "raster") +
                       ", expected one: " + list_of(names),
                   "give the name of one of them in place of the file: '" + names.front() + "'");
}

void check_one_band(GDALDataset& dataset, const std::string& path) {
  const int n_bands = dataset.GetRasterCount();
  if (n_bands == 1 || (n_bands == 2 && is_alpha(dataset, 2))) return;
  if (n_bands < 1)
    throw InputError({path}, "holds no raster",
                     "gdalinfo " + path + " shows what GDAL makes of it");
  // A picture says of its bands that they are red, green and blue; a mask may be one of them.
  const bool has_alpha = is_alpha(dataset, n_bands);
  const std::string mask = has_alpha ? " -mask " + std::to_string(n_bands) : std::string();
  throw InputError({path}, "the raster has " + std::to_string(n_bands) + " bands, expected one",
                   "gdal_translate -b 1" + mask + " " + path + " one_band.tif" +
                       (has_alpha || n_bands != 2
                            ? ""
                            : "; where band 2 says which cells are known: gdal_translate -b 1 "
                              "-mask 2 " +
                                  path + " one_band.tif"));
}

}  // namespace talus
