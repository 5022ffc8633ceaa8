#include "io/raster_bands_gdal.hpp"

#include <gdal_priv.h>
#include <gdal_utils.h>

#include <cstring>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/errors_gdal.hpp"
#include "io/network_gdal.hpp"

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

void replace_all(const std::string& from, const std::string& to, std::string& in) {
  for (std::size_t at = in.find(from); at != std::string::npos; at = in.find(from, at + to.size()))
    in.replace(at, from.size(), to);
}

void refuse_several_rasters(GDALDataset& dataset, const std::string& path) {
  const std::vector<std::string> names = subdatasets(dataset);
  if (names.empty() || (names.size() == 1 && dataset.GetRasterCount() > 0)) return;
  throw InputError({path},
                   "holds " + counted(static_cast<int>(names.size()), "raster") +
                       ", expected one: " + list_of(names),
                   "give the name of one of them in place of the file: '" + names.front() + "'");
}

}  // namespace

void CloseDataset::operator()(GDALDataset* dataset) const { GDALClose(dataset); }

Dataset open_raster(const std::string& path) {
  register_gdal_drivers();
  check_virtual(path);
  const GdalErrors errors;
  Dataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
  if (!dataset)
    throw InputError({path}, "cannot be opened as a raster: " + errors.failure(),
                     way_to_open(path, "gdalinfo " + path + " shows what GDAL makes of it"));
  check_tables(*dataset, path);
  refuse_several_rasters(*dataset, path);
  return dataset;
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

std::string with_alpha_as_mask(GDALDataset& dataset) {
  if (dataset.GetRasterCount() != 2 || !is_alpha(dataset, 2)) return {};
  const GDALDataType type = dataset.GetRasterBand(2)->GetRasterDataType();
  const double opaque = type == GDT_UInt16 ? 65535 : type == GDT_Int16 ? 32767 : 255;
  CPLStringList words;
  for (const char* word : {"-of", "VRT", "-b", "1", "-mask", "2"}) words.AddString(word);
  GDALTranslateOptions* const options = GDALTranslateOptionsNew(words.List(), nullptr);
  GDALDatasetH handle = &dataset;
  const GDALDatasetUniquePtr made(
      GDALDataset::FromHandle(GDALTranslate("", handle, options, nullptr)));
  GDALTranslateOptionsFree(options);
  char** const xml = made ? made->GetMetadata("xml:VRT") : nullptr;
  if (xml == nullptr || *xml == nullptr) return {};
  std::string text(*xml);
  const std::size_t begin = text.find("<MaskBand>"), end = text.find("</MaskBand>");
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::string mask = text.substr(begin, end - begin);
  replace_all("SimpleSource>", "ComplexSource>", mask);
  replace_all("</ComplexSource>",
              "<LUT>0:0," + talus::text(opaque - 1e-3, 12) + ":0," + talus::text(opaque, 12) +
                  ":255</LUT></ComplexSource>",
              mask);
  return text.replace(begin, end - begin, mask);
}

}  // namespace talus
