#include "io/network_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_vsi_virtual.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/network.hpp"
#include "base/read_file.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

constexpr const char* refusal = "is on a network, which this tool does not use";
constexpr const char* way_out =
    "fetch it first and name the copy, or give --allow-network for files that you trust";

// Drivers whose data sets are always elsewhere.
constexpr const char* network_drivers[] = {
    "WMS",          "WCS",    "WFS",      "WMTS",          "OAPIF",      "OGCAPI",
    "CSW",          "HTTP",   "PLMOSAIC", "PLSCENES",      "EEDA",       "EEDAI",
    "DAAS",         "STACTA", "STACIT",   "PostGISRaster", "PostgreSQL", "MySQL",
    "MSSQLSpatial", "ODBC",   "OGR_OGDI", "Elasticsearch", "Carto",      "AmigoCloud",
    "NGW",          "GMLAS",  "GPSBabel", "RDA",           "HANA",       "MongoDBv3"};

constexpr const char* network_folders[] = {"/vsicurl/",
                                           "/vsicurl?",
                                           "/vsicurl_streaming/",
                                           "/vsis3/",
                                           "/vsis3_streaming/",
                                           "/vsigs/",
                                           "/vsigs_streaming/",
                                           "/vsiaz/",
                                           "/vsiaz_streaming/",
                                           "/vsiadls/",
                                           "/vsioss/",
                                           "/vsioss_streaming/",
                                           "/vsiswift/",
                                           "/vsiswift_streaming/",
                                           "/vsihdfs/",
                                           "/vsiwebhdfs/"};

class NoFiles : public VSIFilesystemHandler {
 public:
  VSIVirtualHandle* Open(const char* name, const char* /*access*/, bool /*set_error*/,
                         CSLConstList /*options*/) override {
    CPLError(CE_Failure, CPLE_OpenFailed, "%s %s", name, refusal);
    errno = EACCES;
    return nullptr;
  }
  int Stat(const char* /*name*/, VSIStatBufL* /*stat*/, int /*flags*/) override {
    errno = EACCES;
    return -1;
  }
};

CPLHTTPResult* fetch_nothing(const char* url, CSLConstList /*options*/, GDALProgressFunc /*told*/,
                             void* /*data*/, CPLHTTPFetchWriteFunc /*write*/, void* /*to*/,
                             void* /*user*/) {
  CPLError(CE_Failure, CPLE_AppDefined, "%s %s", url, refusal);
  auto* const result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  result->nStatus = 1;
  result->pszErrBuf = CPLStrdup(refusal);
  return result;
}

// The beginning of a virtual data set is that of an XML file of one of these.
bool is_virtual_data(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(4096, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  for (const char* mark : {"<VRTDataset", "<OGRVRTDataSource", "<OGRVRTLayer", "<GDAL_WMS"})
    if (begin.find(mark) != std::string::npos) return true;
  return false;
}

bool is_elsewhere(const std::string& source) {
  for (const char* folder : network_folders)
    if (source.find(folder) != std::string::npos) return true;
  return source.find("://") != std::string::npos;
}

// What a virtual data set takes its values from.
struct NamedSource {
  std::string name;
  bool is_beside = false;  // relative to the folder of the data set
};

std::vector<NamedSource> sources_in(const std::string& xml) {
  std::vector<NamedSource> sources;
  for (const char* tag : {"<SourceFilename", "<SourceDataset", "<SrcDataSource"})
    for (std::size_t at = xml.find(tag); at != std::string::npos; at = xml.find(tag, at + 1)) {
      const std::size_t begin = xml.find('>', at), end = xml.find('<', begin);
      if (end == std::string::npos) break;
      const std::string attributes = xml.substr(at, begin - at);
      sources.push_back({xml.substr(begin + 1, end - begin - 1),
                         attributes.find("=\"1\"") != std::string::npos ||
                             attributes.find("='1'") != std::string::npos});
    }
  return sources;
}

// `n_read`: virtual data sets read so far. Each may name the next one many times.
void check_virtual(const fs::path& path, int depth, int& n_read) {
  constexpr int deepest = 16, most = 10000;
  if (!fs::is_regular_file(path) || !is_virtual_data(path.string())) return;
  const Where where{path.string()};
  if (++n_read > most)
    throw InputError(where,
                     "is one of more than " + std::to_string(most) +
                         " virtual data sets that lead to one another",
                     "gdal_translate the first of them to a GeoTIFF where it is trusted");
  if (depth > deepest)
    throw InputError(where, "is a virtual data set of virtual data sets without end");
  const std::string text = read_file(path.string());
  if (text.find("<GDAL_WMS") != std::string::npos) throw InputError(where, refusal, way_out);
  if (text.find("VRTRawRasterBand") != std::string::npos)
    throw InputError(where, "takes the raw bytes of a file as heights",
                     "gdal_translate it to a GeoTIFF where it is trusted, or give --allow-network");
  for (const NamedSource& source : sources_in(text)) {
    if (is_elsewhere(source.name))
      throw InputError(where, "names " + source.name + ", which " + refusal, way_out);
    check_virtual(source.is_beside ? path.parent_path() / source.name : fs::path(source.name),
                  depth + 1, n_read);
  }
}

}  // namespace

void forbid_network() {
  if (network_is_allowed()) return;
  for (const char* name : network_drivers)
    if (const GDALDriverH driver = GDALGetDriverByName(name)) GDALDeregisterDriver(driver);
  CPLSetConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
  CPLSetConfigOption("GML_DOWNLOAD_SCHEMA", "NO");
  static NoFiles no_files;
  for (const char* folder : network_folders) VSIFileManager::InstallHandler(folder, &no_files);
  CPLHTTPPushFetchCallback(fetch_nothing, nullptr);
  OSRSetPROJEnableNetwork(0);
}

void check_virtual(const std::string& path) {
  if (network_is_allowed()) return;
  if (is_elsewhere(path)) throw InputError({path}, refusal, way_out);
  int n_read = 0;
  check_virtual(fs::path(path), 0, n_read);
}

}  // namespace talus
