// Opens a vector source: archives, tables of points, damaged tables.
#include "import/vector_dataset_gdal.hpp"

#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "base/file_paths.hpp"
#include "base/text.hpp"
#include "import/point_table.hpp"
#include "io/archives_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "io/network_gdal.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

// --- tables of points ----------------------------------------------------------------------------

std::string read_all(const std::string& source) {
  const GdalErrors errors;
  GByte* bytes = nullptr;
  vsi_l_offset size = 0;
  if (VSIIngestFile(nullptr, source.c_str(), &bytes, &size, -1) == 0)
    throw InputError({source}, "cannot be read: " + errors.failure());
  std::string text(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  VSIFree(bytes);
  return text;
}

// The coordinates become points, the other columns fields.
VectorDataset table_as_dataset(const PointTable& table, const std::string& name) {
  const ColumnText& columns = table.columns;
  VectorDataset made;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("Memory");
  made.dataset = GDALDatasetUniquePtr(driver->Create(name.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  OGRSpatialReference degrees;
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (table.is_degrees) degrees.importFromEPSG(4326);
  OGRLayer* layer =
      made.dataset->CreateLayer(name.c_str(), table.is_degrees ? &degrees : nullptr, wkbPoint);
  std::vector<std::size_t> fields;  // their columns
  for (std::size_t c = 0; c < columns.names.size(); ++c) {
    if (c == table.x || c == table.y) continue;
    OGRFieldDefn field(columns.names[c].c_str(), table.is_number[c] ? OFTReal : OFTString);
    layer->CreateField(&field);
    fields.push_back(c);
  }
  for (std::size_t row = 0; row < columns.rows.size(); ++row) {
    OGRFeature feature(layer->GetLayerDefn());
    feature.SetFID(columns.line[row]);
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const std::string& word = columns.rows[row][fields[k]];
      double value = 0;
      if (table.is_number[fields[k]] && parse_number(columns, word, value))
        feature.SetField(static_cast<int>(k), value);
      else if (!word.empty())
        feature.SetField(static_cast<int>(k), word.c_str());
    }
    OGRPoint point(table.points[row].x(), table.points[row].y());
    feature.SetGeometry(&point);
    if (layer->CreateFeature(&feature) != OGRERR_NONE)
      throw InputError({columns.file, columns.line[row]}, "cannot be kept as a point");
  }
  made.is_y_first = table.y < table.x && plain_name(columns.names[table.y]) == "y";
  made.remarks.push_back("x from " + columns.names[table.x] + ", y from " + columns.names[table.y] +
                         (table.is_degrees ? ", taken to be in EPSG:4326 (WGS 84)" : ""));
  return made;
}

// --- tables beside shapes ------------------------------------------------------------------------

// The first n bytes of a file and its size; nothing where it cannot be read.
struct FileHead {
  std::vector<unsigned char> bytes;
  std::int64_t size = -1;
};

FileHead head_of(const std::string& file, std::size_t n) {
  FileHead head;
  VSILFILE* const in = VSIFOpenL(file.c_str(), "rb");
  if (in == nullptr) return head;
  head.bytes.resize(n);
  head.bytes.resize(VSIFReadL(head.bytes.data(), 1, n, in));
  VSIFSeekL(in, 0, SEEK_END);
  head.size = static_cast<std::int64_t>(VSIFTellL(in));
  VSIFCloseL(in);
  return head;
}

std::int64_t little_endian(const FileHead& head, std::size_t at, std::size_t n) {
  std::int64_t value = 0;
  for (std::size_t i = n; i-- > 0;) value = 256 * value + head.bytes[at + i];
  return value;
}

// Rows of a dBASE table (.dbf, MapInfo's .dat): as its header says and as it has room for; of a
// table as text (.mid) its lines. -1: it is none.
std::int64_t rows_of_table(const std::string& file) {
  if (extension_of(file) == ".mid") {
    const std::string lines = read_all(file);
    return std::count(lines.begin(), lines.end(), '\n') +
           (lines.empty() || lines.back() == '\n' ? 0 : 1);
  }
  constexpr std::size_t n_needed = 12;
  const FileHead head = head_of(file, n_needed);
  if (head.bytes.size() < n_needed) return -1;
  const std::int64_t n_rows = little_endian(head, 4, 4), begin = little_endian(head, 8, 2),
                     row_size = little_endian(head, 10, 2);
  if (row_size <= 0) return -1;
  return std::min(n_rows, std::max<std::int64_t>(0, head.size - begin) / row_size);
}

// Shapes of a Shapefile by its index (.shx), objects of a MapInfo table by its own (.id), or as
// GDAL counts them where they are text. -1: there are none.
std::int64_t shapes_of(GDALDataset& dataset, const std::string& file) {
  if (extension_of(file) == ".mif") {
    OGRLayer* const layer = dataset.GetLayerByName(fs::path(file).stem().c_str());
    return layer != nullptr ? layer->GetFeatureCount() : -1;
  }
  const FileHead head = head_of(file, 0);
  if (head.size < 0) return -1;
  return extension_of(file) == ".shx" ? (head.size - 100) / 8 : head.size / 4;
}

std::string without_extension(const std::string& file) {
  return fs::path(file).replace_extension().string();
}

// Shapes and rows belong together by their numbers alone: where one is lost, all behind it have the
// values of other rows, and GDAL does not say so.
void check_rows(GDALDataset& dataset) {
  const std::string driver = dataset.GetDriverName();
  if (driver != "ESRI Shapefile" && driver != "MapInfo File") return;
  const CPLStringList files(dataset.GetFileList());
  std::map<std::string, std::pair<std::string, std::string>> parts;  // of shapes and of rows
  for (int i = 0; i < files.size(); ++i) {
    const std::string file = files[i], extension = extension_of(file);
    auto& [shapes, table] = parts[without_extension(file)];
    if (extension == ".shx" || extension == ".id" || extension == ".mif") shapes = file;
    if (extension == ".dbf" || extension == ".dat" || extension == ".mid") table = file;
  }
  for (const auto& [name, part] : parts) {
    if (part.first.empty() || part.second.empty()) continue;
    const std::int64_t n_shapes = shapes_of(dataset, part.first),
                       n_rows = rows_of_table(part.second);
    if (n_shapes < 0 || n_rows < 0 || n_shapes == n_rows) continue;
    throw InputError({part.second},
                     "the table has " + counted(n_rows, "row") + ", the file beside it " +
                         counted(n_shapes, "shape") + ": which row is of which shape is not known",
                     std::string("export the data again from the program that they come from") +
                         (extension_of(part.second) == ".dbf"
                              ? "; a copy without the .dbf holds the shapes alone"
                              : ""));
  }
}

}  // namespace

VectorDataset open_vectors(const SourcePath& path) {
  register_gdal_drivers();
  VectorDataset opened;
  const std::string source = source_in(path, Contents::vectors, opened.remarks);
  const std::string named =
      lower(source).ends_with(".gz") ? source.substr(0, source.size() - 3) : source;
  if (is_table_name(named)) {
    const std::string text = read_all(source);
    if (!has_wkt_column(text)) {
      VectorDataset made =
          table_as_dataset(parse_point_table(text, path.file), fs::path(named).stem().string());
      made.remarks.insert(made.remarks.begin(), opened.remarks.begin(), opened.remarks.end());
      return made;
    }
  }
  check_virtual(source);
  const GdalErrors errors;
  opened.dataset = GDALDatasetUniquePtr(
      GDALDataset::Open(source.c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR));
  if (!opened.dataset)
    throw InputError(
        {path.file},
        "cannot be opened as vectors" + (errors.failed() ? ": " + errors.failure() : std::string()),
        errors.failure().find("SHAPE_RESTORE_SHX") != std::string::npos
            ? "make the index (.shx) anew: ogr2ogr --config SHAPE_RESTORE_SHX YES restored.gpkg " +
                  command_words(source)
            : way_to_open(source, false,
                          "ogrinfo " + command_words(source) + " shows what GDAL makes of it"));
  check_tables(*opened.dataset, path.file);
  check_rows(*opened.dataset);
  return opened;
}

}  // namespace talus
