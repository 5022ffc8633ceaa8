#include "io/network_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi_virtual.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/network.hpp"
#include "io/foreign_hdf5.hpp"

namespace talus {
namespace {

constexpr const char* refusal = "is on a network, which this tool does not use";
constexpr const char* permission = "--allow-network";
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

// Drivers whose headers name the file of raw bytes to read, or (MRF) the file to write.
constexpr const char* raw_drivers[] = {"EIR",  "ERS",  "ILWIS", "ISIS2",  "ISIS3",
                                       "MRF",  "NDF",  "PAux",  "PCIDSK", "PDS",
                                       "PDS4", "FAST", "MFF",   "SNODAS"};

using Open = GDALDataset* (*)(GDALOpenInfo*);

// GDAL's own words for what it opened: the file may spell them in many ways.
bool takes_raw_bytes(GDALDataset& dataset) {
  char** const xml = dataset.GetMetadata("xml:VRT");
  if (xml == nullptr || std::strstr(xml[0], "\"VRTRawRasterBand\"") == nullptr) return false;
  CPLError(CE_Failure, CPLE_OpenFailed,
           "a virtual raster takes the raw bytes of a file as heights, which needs %s", permission);
  return true;
}

// The module of a virtual table in small letters; "" where the statement is spelled otherwise than
// SQLite, GDAL and SpatiaLite spell it.
std::string module_of(std::string sql) {
  constexpr std::string_view begin = "create virtual table ";
  for (char& c : sql) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (!sql.starts_with(begin) || sql.size() == begin.size()) return "";
  std::size_t at = begin.size();
  const char quote = sql[at] == '[' ? ']' : sql[at];
  const bool is_quoted = quote == '"' || quote == '\'' || quote == '`' || quote == ']';
  at = is_quoted ? sql.find(quote, at + 1) + 1 : sql.find(' ', at);
  constexpr std::string_view using_word = " using ";
  if (at == 0 || at == std::string::npos || sql.compare(at, using_word.size(), using_word) != 0)
    return "";
  at += using_word.size();
  return sql.substr(at, sql.find_first_of(" (", at) - at);
}

// A virtual table reads whatever its module reads: texts, tables and vectors of the machine. Those
// of indices and of SpatiaLite's own lists read the data base alone.
bool is_own_table(const std::string& sql) {
  static const std::set<std::string> own = {
      "rtree", "rtree_i32",           "geopoly",           "fts3",       "fts4",
      "fts5",  "virtualspatialindex", "virtualelementary", "virtualknn", "virtualknn2"};
  return own.contains(module_of(sql));
}

bool has_foreign_tables(GDALDataset& database) {
  OGRLayer* const tables = database.ExecuteSQL(
      "SELECT '' AS name, '' AS sql UNION ALL "
      "SELECT name, sql FROM sqlite_master WHERE type = 'table' AND rootpage = 0",
      nullptr, nullptr);
  std::string found = tables == nullptr ? "(its list cannot be read)" : "";
  if (tables != nullptr) {
    for (const auto& row : *tables)
      if (const std::string sql = row->GetFieldAsString(1); !sql.empty() && !is_own_table(sql))
        found = row->GetFieldAsString(0);
    database.ReleaseResultSet(tables);
  }
  if (found.empty()) return false;
  CPLError(CE_Failure, CPLE_OpenFailed,
           "the virtual table %s of a data base reads other files, which needs %s", found.c_str(),
           permission);
  return true;
}

// HDF5 and netCDF 4. Looked at while GDAL has it closed: both open it in ways that exclude each
// other.
bool is_kept_elsewhere(const CPLStringList& files) {
  std::string found;
  try {
    const std::string file = files.empty() ? "" : files[0];
    found = file.starts_with("/vsi") ? "a packed file" : kept_in_another_file(file);
  } catch (const InputError& error) {
    found = error.what();
  }
  if (!found.empty())
    CPLError(CE_Failure, CPLE_OpenFailed, "what %s holds may stand in another file, which needs %s",
             found.c_str(), permission);
  return !found.empty();
}

// What a driver opens is handed on, or closed again where it reads what nobody named.
enum class Guarded { vrt, sqlite, geopackage, hdf5, hdf5_image, netcdf, bag };

GDALDataset* open_checked(Guarded kind, Open original, GDALOpenInfo* info) {
  GDALDatasetUniquePtr dataset(original(info));
  if (!dataset) return nullptr;
  bool is_refused = false;
  if (kind == Guarded::vrt) {
    is_refused = takes_raw_bytes(*dataset);
  } else if (kind == Guarded::sqlite || kind == Guarded::geopackage) {
    is_refused = has_foreign_tables(*dataset);
  } else {
    const CPLStringList files(dataset->GetFileList());
    dataset.reset();
    is_refused = is_kept_elsewhere(files);
    if (!is_refused) dataset.reset(original(info));
  }
  return is_refused ? nullptr : dataset.release();
}

// GDAL ends with a fault where one is destroyed (3.6), so they stay to the end.
void take_out(const char* driver_name) {
  static auto& taken = *new std::vector<GDALDriverH>;
  const GDALDriverH driver = GDALGetDriverByName(driver_name);
  if (driver == nullptr) return;
  GDALDeregisterDriver(driver);
  taken.push_back(driver);
}

// A driver that opens by other ways cannot be guarded, and is taken out.
template <Guarded kind>
void guard(const char* driver_name) {
  static Open original = nullptr;
  auto* const driver = static_cast<GDALDriver*>(GDALGetDriverByName(driver_name));
  if (driver == nullptr) return;
  if (driver->pfnOpen == nullptr) return take_out(driver_name);
  original = driver->pfnOpen;
  driver->pfnOpen = [](GDALOpenInfo* info) { return open_checked(kind, original, info); };
}

// The beginning of a virtual data set is that of an XML file of one of these.
bool is_virtual_data(const std::string& begin) {
  for (const char* mark : {"<VRTDataset", "<OGRVRTDataSource", "<OGRVRTLayer", "<GDAL_WMS"})
    if (begin.find(mark) != std::string::npos) return true;
  return false;
}

// The text of a virtual data set, which may also stand in place of its name; "" for other files.
std::string virtual_text(const std::string& name) {
  if (name.find('<') != std::string::npos && is_virtual_data(name)) return name;
  VSIStatBufL stat;
  if (VSIStatL(name.c_str(), &stat) != 0 || !VSI_ISREG(stat.st_mode)) return "";
  const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> file(VSIFOpenL(name.c_str(), "rb"),
                                                           VSIFCloseL);
  if (!file) return "";
  std::string text(4096, '\0');
  text.resize(VSIFReadL(text.data(), 1, text.size(), file.get()));
  if (!is_virtual_data(text)) return "";
  text.resize(stat.st_size);
  VSIFSeekL(file.get(), 0, SEEK_SET);
  text.resize(VSIFReadL(text.data(), 1, text.size(), file.get()));
  return text;
}

// A name with a scheme (http://), which that of a raster within an HDF5 file has not
// (HDF5:"a.h5"://group/b).
bool is_elsewhere(const std::string& source) {
  for (const char* folder : network_folders)
    if (source.find(folder) != std::string::npos) return true;
  const auto is_of_scheme = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-';
  };
  for (std::size_t at = source.find("://"); at != std::string::npos;
       at = source.find("://", at + 1)) {
    std::size_t begin = at;
    while (begin > 0 && is_of_scheme(source[begin - 1])) --begin;
    const bool is_ending = begin > 0 && source[begin - 1] == '.';  // HDF5:a.h5://b
    if (begin < at && !is_ending) return true;
  }
  return false;
}

// Adds what a virtual data set in `folder` takes its values from. GDAL distinguishes no case.
void add_sources(const CPLXMLNode* node, const char* folder, std::vector<std::string>& sources) {
  for (; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element) continue;
    for (const char* tag : {"SourceFilename", "SourceDataset", "SrcDataSource"}) {
      if (!EQUAL(node->pszValue, tag)) continue;
      const char* const name = CPLGetXMLValue(node, nullptr, "");
      const bool is_beside = CPLTestBool(CPLGetXMLValue(node, "relativeToVRT", "0"));
      sources.emplace_back(is_beside ? CPLProjectRelativeFilename(folder, name) : name);
    }
    add_sources(node->psChild, folder, sources);
  }
}

std::vector<std::string> sources_in(const std::string& name, const std::string& xml) {
  const CPLErrorStateBackuper kept;
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  const CPLXMLTreeCloser tree(CPLParseXMLString(xml.c_str()));
  std::vector<std::string> sources;
  add_sources(tree.get(), std::string(CPLGetPath(name.c_str())).c_str(), sources);
  return sources;
}

// `n_read`: virtual data sets read so far. Each may name the next one many times.
void check_virtual(const std::string& name, int depth, int& n_read) {
  constexpr int deepest = 16, most = 10000;
  const std::string text = virtual_text(name);
  if (text.empty()) return;
  const Where where{name};
  if (++n_read > most)
    throw InputError(where,
                     "is one of more than " + std::to_string(most) +
                         " virtual data sets that lead to one another",
                     "gdal_translate the first of them to a GeoTIFF where it is trusted");
  if (depth > deepest)
    throw InputError(where, "is a virtual data set of virtual data sets without end");
  if (text.find("<GDAL_WMS") != std::string::npos) throw InputError(where, refusal, way_out);
  for (const std::string& source : sources_in(name, text)) {
    if (is_elsewhere(source))
      throw InputError(where, "names " + source + ", which " + refusal, way_out);
    check_virtual(source, depth + 1, n_read);
  }
}

}  // namespace

void forbid_network() {
  if (network_is_allowed()) return;
  for (const char* name : network_drivers) take_out(name);
  for (const char* name : raw_drivers) take_out(name);
  guard<Guarded::vrt>("VRT");
  guard<Guarded::sqlite>("SQLite");
  guard<Guarded::geopackage>("GPKG");
  guard<Guarded::hdf5>("HDF5");
  guard<Guarded::hdf5_image>("HDF5Image");
  guard<Guarded::netcdf>("netCDF");
  guard<Guarded::bag>("BAG");
  CPLSetConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
  CPLSetConfigOption("GML_DOWNLOAD_SCHEMA", "NO");
  static NoFiles no_files;
  for (const char* folder : network_folders) VSIFileManager::InstallHandler(folder, &no_files);
  CPLHTTPPushFetchCallback(fetch_nothing, nullptr);
}

void check_virtual(const std::string& path) {
  if (network_is_allowed()) return;
  if (is_elsewhere(path)) throw InputError({path}, refusal, way_out);
  int n_read = 0;
  check_virtual(path, 0, n_read);
}

std::string needs_permission(const std::string& failure) {
  if (failure.find(permission) != std::string::npos)
    return std::string("give ") + permission +
           " for files that you trust, or copy what they hold: "
           "gdal_translate to a GeoTIFF, ogr2ogr to a GeoPackage";
  if (network_is_allowed() || failure.find("not recognized") == std::string::npos) return "";
  std::string names;
  for (const char* name : raw_drivers) names += (names.empty() ? "" : ", ") + std::string(name);
  return "is it a raster? Formats whose header names another file need " + std::string(permission) +
         ": " + names;
}

}  // namespace talus
