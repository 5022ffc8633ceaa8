// Keeps GDAL from network access and from files that nobody named.
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
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/network.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

constexpr const char* refusal = "is on a network, which this tool does not use";
constexpr const char* way_out =
    "fetch it first and name the copy, or give --allow-network for files that you trust";

// The command that makes a copy with its own values.
std::string copy_of_own(const std::string& path, bool is_raster) {
  return (is_raster
              ? "copy what it holds: gdal_translate " + command_words(path) + " copy.tif"
              : "copy what it holds: ogr2ogr -skipfailures copy.gpkg " + command_words(path)) +
         ", or give --allow-network for files that you trust";
}

// Formats whose files hold their own values, or have them beside them under the same name.
constexpr const char* trusted_drivers[] = {
    // rasters
    "GTiff", "COG", "VRT", "MEM", "GPKG", "HFA", "AIG", "AAIGrid", "GRASSASCIIGrid", "ISG", "SDTS",
    "DTED", "PNG", "JPEG", "JP2OpenJPEG", "WEBP", "GIF", "BMP", "SRTMHGT", "USGSDEM", "RST", "GSAG",
    "GSBG", "GS7BG", "PCRaster", "SAGA", "RRASTER", "ENVI", "EHdr", "BT", "GTX", "NTv2", "GXF",
    "NWT_GRD", "XYZ", "ZMap", "HF2", "ARG", "BYN", "SIGDEM", "LCP",
    // vectors
    "Memory", "OGR_VRT", "SQLite", "ESRI Shapefile", "MapInfo File", "OpenFileGDB", "FlatGeobuf",
    "GeoJSON", "GeoJSONSeq", "ESRIJSON", "TopoJSON", "GML", "NAS", "KML", "LIBKML", "GPX", "CSV",
    "XLS", "XLSX", "ODS", "DXF", "CAD", "DGN", "UK .NTF", "OGR_SDTS", "OGR_GMT", "S57", "EDIGEO",
    "VFK", "SXF", "Interlis 1", "Interlis 2", "AVCBin", "AVCE00", "JML", "OSM"};

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

// GDAL ends with a fault where a driver is destroyed (3.6), so they stay to the end.
std::vector<GDALDriver*>& drivers_taken_out() {
  static auto& taken = *new std::vector<GDALDriver*>;
  return taken;
}

void take_out_other_drivers() {
  const std::set<std::string> trusted(std::begin(trusted_drivers), std::end(trusted_drivers));
  GDALDriverManager& drivers = *GetGDALDriverManager();
  for (int i = 0; i < drivers.GetDriverCount(); ++i)
    if (GDALDriver* const driver = drivers.GetDriver(i);
        !trusted.contains(driver->GetDescription()))
      drivers_taken_out().push_back(driver);
  for (GDALDriver* const driver : drivers_taken_out()) drivers.DeregisterDriver(driver);
}

// The beginning of a virtual data set is that of an XML file of one of these.
bool is_virtual_data(const std::string& begin) {
  for (const char* mark : {"<VRTDataset", "<OGRVRTDataSource", "<OGRVRTLayer", "<GDAL_WMS"})
    if (begin.find(mark) != std::string::npos) return true;
  return false;
}

// The text of a virtual data set, which may also be given in place of its name; "" for other files.
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

// Sources of the values of a virtual raster.
struct Sources {
  std::vector<std::string> names;
  bool has_raw_bytes = false;  // of a file that need not be a raster
};

// Of a virtual raster in `folder`. GDAL distinguishes no case.
void add_sources(const CPLXMLNode* node, const char* folder, Sources& sources) {
  for (; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element) continue;
    if (EQUAL(CPLGetXMLValue(node, "subClass", ""), "VRTRawRasterBand"))
      sources.has_raw_bytes = true;
    for (const char* tag : {"SourceFilename", "SourceDataset", "SrcDataSource"}) {
      if (!EQUAL(node->pszValue, tag)) continue;
      const char* const name = CPLGetXMLValue(node, nullptr, "");
      const bool is_beside = CPLTestBool(CPLGetXMLValue(node, "relativeToVRT", "0"));
      sources.names.emplace_back(is_beside ? CPLProjectRelativeFilename(folder, name) : name);
    }
    add_sources(node->psChild, folder, sources);
  }
}

Sources sources_in(const std::string& name, const std::string& xml) {
  const CPLErrorStateBackuper kept;
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  const CPLXMLTreeCloser tree(CPLParseXMLString(xml.c_str()));
  Sources sources;
  add_sources(tree.get(), std::string(CPLGetPath(name.c_str())).c_str(), sources);
  return sources;
}

// A data base that a virtual data set names is opened by GDAL itself.
void check_database(const std::string& source) {
  const char* const drivers[] = {"SQLite", "GPKG", nullptr};
  const CPLErrorStateBackuper kept;
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  const GDALDatasetUniquePtr database(
      GDALDataset::Open(source.c_str(), GDAL_OF_VECTOR | GDAL_OF_RASTER, drivers));
  if (database) check_tables(*database, source);
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
                     copy_of_own(name, text.find("<VRTDataset") != std::string::npos));
  if (depth > deepest)
    throw InputError(where, "is a virtual data set of virtual data sets without end");
  if (text.find("<GDAL_WMS") != std::string::npos) throw InputError(where, refusal, way_out);
  const Sources sources = sources_in(name, text);
  if (sources.has_raw_bytes)
    throw InputError(where, "is a virtual raster that takes the raw bytes of a file as heights",
                     copy_of_own(name, true));
  for (const std::string& source : sources.names) {
    if (is_elsewhere(source))
      throw InputError(where, "names " + source + ", which " + refusal, way_out);
    check_virtual(source, depth + 1, n_read);
    check_database(source);
  }
}

}  // namespace

void forbid_network() {
  if (network_is_allowed()) return;
  take_out_other_drivers();
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

void check_tables(GDALDataset& database, const std::string& path) {
  const std::string driver = database.GetDriverName();
  if (network_is_allowed() || (driver != "SQLite" && driver != "GPKG")) return;
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
  if (!found.empty())
    throw InputError({path}, "its virtual table " + found + " reads other files",
                     copy_of_own(path, false));
}

std::string way_to_open(const std::string& path, bool as_raster, const std::string& otherwise) {
  struct Ending {
    const char* end;
    const char* way;
  };
  for (const Ending& known :
       {Ending{".parquet",
               "GDAL reads GeoParquet with its driver Parquet, which Debian 12 has not: "
               "export a GeoPackage"},
        Ending{".dwg", "GDAL reads DWG of the year 2000 alone: save it as DXF"},
        Ending{".7z", "unpack it: archives that are read end in .zip or .tar"},
        Ending{".rar", "unpack it: archives that are read end in .zip or .tar"},
        Ending{".stl", "export the surface as OBJ or LandXML, for talus-trn"}})
    if (lower(path).ends_with(known.end)) return known.way;
  const CPLErrorStateBackuper kept;
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  GDALOpenInfo info(path.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY);
  for (GDALDriver* const driver : drivers_taken_out())
    if (driver->pfnIdentify != nullptr && driver->pfnIdentify(&info) == 1)
      return "files of the format " + std::string(driver->GetDescription()) +
             " may name other files: " +
             copy_of_own(path, driver->GetMetadataItem(GDAL_DCAP_RASTER) != nullptr);
  const unsigned other = as_raster ? GDAL_OF_VECTOR : GDAL_OF_RASTER;
  if (GDALDataset* const dataset = GDALDataset::Open(path.c_str(), other); dataset != nullptr) {
    GDALClose(dataset);
    return as_raster ? "it holds vectors, expected a raster; a terrain of contours or points is "
                       "made by talus-tin, then talus-trn"
                     : "it is a raster, expected vectors; an elevation model is for talus-trn";
  }
  return otherwise;
}

}  // namespace talus
