// Opens a raster and checks its band, mask and place on the map.
#include "io/raster_bands_gdal.hpp"

#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <vector>

#include "base/error.hpp"
#include "base/file_paths.hpp"
#include "base/read_file.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "io/archives_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "io/network_gdal.hpp"

namespace talus {
namespace {

bool is_alpha(GDALDataset& dataset, int band) {
  return dataset.GetRasterBand(band)->GetColorInterpretation() == GCI_AlphaBand;
}

// Three or four bands of bytes, or bands that are called colours.
bool is_picture(GDALDataset& dataset) {
  const int n_bands = dataset.GetRasterCount();
  int n_bytes = 0;
  for (int band = 1; band <= n_bands; ++band) {
    const GDALColorInterp colour = dataset.GetRasterBand(band)->GetColorInterpretation();
    if (colour == GCI_RedBand || colour == GCI_GreenBand || colour == GCI_BlueBand) return true;
    if (dataset.GetRasterBand(band)->GetRasterDataType() == GDT_Byte) ++n_bytes;
  }
  return n_bytes == n_bands && (n_bands == 3 || n_bands == 4);
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

// The rasters of a folder that are named like the first that GDAL knows.
std::vector<std::string> rasters_in(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::string> names, rasters;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    const bool is_alike = rasters.empty() || std::filesystem::path(name).extension() ==
                                                 std::filesystem::path(rasters.front()).extension();
    if (is_alike && GDALIdentifyDriver(name.c_str(), nullptr) != nullptr) rasters.push_back(name);
  }
  return rasters;
}

void refuse_folder(const std::string& path) {
  const std::vector<std::string> rasters = rasters_in(path);
  if (rasters.empty())
    throw InputError({path}, "is a folder, expected a raster", "name a file in it");
  throw InputError(
      {path},
      "is a folder, expected a raster; it holds " +
          counted(static_cast<std::int64_t>(rasters.size()), "raster") + ": " + list_of(rasters),
      way_to_one_raster(rasters, rasters,
                        "gdalbuildvrt all.vrt " + shell_word(path) + "/*" +
                            std::filesystem::path(rasters.front()).extension().string()));
}

// Deliveries that need another step first.
void refuse_what_is_not_a_raster(const std::string& path) {
  std::error_code error;
  const std::string extension = extension_of(path);
  const bool is_folder = std::filesystem::is_directory(path, error);
  if (is_folder && extension != ".adf" && GDALIdentifyDriver(path.c_str(), nullptr) == nullptr)
    refuse_folder(path);
  if (extension == ".las" || extension == ".laz")
    throw InputError({path}, "is a laser scan, expected a raster",
                     ground_points_command(path) + "; then talus-tin ground.csv --points");
}

// The first word of letters in the rows of a grid of text, not in the lines of its header: "nan",
// "NA". Empty: its first bytes hold none.
std::string word_in_grid(const std::string& source) {
  std::string head(1 << 16, '\0');
  VSILFILE* const file = VSIFOpenL(source.c_str(), "rb");
  if (file == nullptr) return {};
  head.resize(VSIFReadL(head.data(), 1, head.size(), file));
  VSIFCloseL(file);
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  std::istringstream lines(head);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> of_line;
    for (std::string word; words >> word;) of_line.push_back(word);
    if (of_line.size() == 2 && is_letter(of_line[0].front())) continue;
    for (const std::string& word : of_line)
      if (std::all_of(word.begin(), word.end(), is_letter)) return word;
  }
  return {};
}

}  // namespace

void CloseDataset::operator()(GDALDataset* dataset) const { GDALClose(dataset); }

std::string way_to_read(const std::string& path, const std::string& otherwise) {
  const bool is_packed = extension_of(path) == ".gz";
  const std::string name = is_packed ? path.substr(0, path.size() - 3) : path;
  if (extension_of(name) != ".asc") return otherwise;
  const std::string word = word_in_grid(is_packed ? "/vsigzip/" + path : path);
  if (word.empty()) return otherwise;
  const bool is_nan = lower(word) == "nan";
  const std::string sed =
      "sed 's/" + (is_nan ? "[nN][aA][nN]" : "\\b" + word + "\\b") + "/-9999/g'";
  return "GDAL takes no row that begins with " + (is_nan ? "nan" : word) + ": " +
         (is_packed ? "gunzip -c " + shell_word(path) + " | " + sed
                    : sed + " " + command_words(path)) +
         " > known.asc";
}

Dataset open_raster(const std::string& path) {
  register_gdal_drivers();
  refuse_what_is_not_a_raster(path);
  std::vector<std::string> remarks;
  const std::string source = source_in(parse_source_path(path), Contents::rasters, remarks);
  check_virtual(source);
  const GdalErrors errors;
  Dataset dataset(GDALDataset::Open(source.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
  if (!dataset)
    throw InputError({path}, "cannot be opened as a raster: " + errors.failure(),
                     way_to_open(source, true,
                                 way_to_read(path, "gdalinfo " + command_words(path) +
                                                       " shows what GDAL makes of it")));
  check_tables(*dataset, path);
  refuse_several_rasters(*dataset, path);
  return dataset;
}

void check_placed(GDALDataset& dataset, const std::string& path, CellKind kind) {
  std::array<double, 6> g{};
  if (dataset.GetGeoTransform(g.data()) == CE_None) return;
  if (const int n_points = dataset.GetGCPCount(); n_points > 0)
    throw InputError({path},
                     "the raster is placed by " + std::to_string(n_points) +
                         " ground control points, expected a geotransform",
                     warp_command(kind, "", path, "placed.tif"));
  throw InputError({path}, "the raster has no place on the map (no geotransform)",
                   translate_command("-a_ullr XMIN YMAX XMAX YMIN", path, "placed.tif"));
}

std::array<double, 6> north_up_place(GDALDataset& dataset, const std::string& path, CellKind kind) {
  check_placed(dataset, path, kind);
  std::array<double, 6> g{};
  dataset.GetGeoTransform(g.data());
  const int n_cols = dataset.GetRasterXSize(), n_rows = dataset.GetRasterYSize();
  const double width = std::hypot(g[1], g[4]), height = std::hypot(g[2], g[5]);
  if (!(std::isfinite(g[0]) && std::isfinite(g[3]) && std::min(width, height) > 0 &&
        std::isfinite(width + height)))
    throw InputError({path}, "the cell is " + text(width) + " by " + text(height) +
                                 ", expected a finite size above 0");
  const std::string warp =
      warp_command(kind, "-tr " + text(width, 6) + " " + text(height, 6), path, "north_up.tif");
  const double skew = std::max(std::abs(g[2]) * n_rows, std::abs(g[4]) * n_cols);
  if (skew > lattice_tolerance * std::min(width, height))
    throw InputError({path},
                     "the raster is rotated (by " + text(std::atan2(g[4], g[1]) / degree, 4) +
                         " degrees), expected north-up",
                     warp);
  if (g[1] < 0 || g[5] > 0)
    throw InputError({path}, "the rows do not run from north to south, expected north-up", warp);
  return g;
}

void check_one_band(GDALDataset& dataset, const std::string& path) {
  const int n_bands = dataset.GetRasterCount();
  if (n_bands == 1 || (n_bands == 2 && is_alpha(dataset, 2))) return;
  if (n_bands < 1)
    throw InputError({path}, "holds no raster",
                     "gdalinfo " + command_words(path) + " shows what GDAL makes of it");
  if (is_picture(dataset))
    throw InputError({path}, "the bands are colours of a picture, expected one band",
                     "give the elevation model itself; of Terrain-RGB: gdal_calc.py -R " +
                         command_words(path) + " --R_band 1 -G " + command_words(path) +
                         " --G_band 2 -B " + command_words(path) +
                         " --B_band 3 --type Float32 --outfile heights.tif --calc "
                         "'(R.astype(float)*65536+G*256.0+B)*0.1-10000'");
  // a mask may be one of several bands
  const bool has_alpha = is_alpha(dataset, n_bands);
  const std::string mask = has_alpha ? " -mask " + std::to_string(n_bands) : std::string();
  throw InputError({path}, "the raster has " + std::to_string(n_bands) + " bands, expected one",
                   translate_command("-b 1" + mask, path, "one_band.tif") +
                       (has_alpha || n_bands != 2
                            ? ""
                            : "; where band 2 says which cells are known: " +
                                  translate_command("-b 1 -mask 2", path, "one_band.tif")));
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
