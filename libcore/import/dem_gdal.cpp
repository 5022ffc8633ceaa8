// Reads elevation rasters as rows of nodes: place, units, nodata, reprojection.
#include "import/dem_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "base/length_units.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/readings.hpp"
#include "import/systems_gdal.hpp"
#include "io/burnt_dams_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "io/judged_heights_gdal.hpp"
#include "io/raster_bands_gdal.hpp"
#include "io/raster_commands.hpp"
#include "terrain/elevation.hpp"
#include "terrain/lone_levels.hpp"
#include "terrain/resample.hpp"

namespace talus {
namespace {

constexpr int rows_at_once = 256;

std::string size_text(int n_rows, int n_cols) {
  return std::to_string(n_cols) + " x " + std::to_string(n_rows) + " cells";
}

// The system that heights in another unit are in says the unit too. The copy is given the plan
// alone, and where that is in feet, the system in metres of the country that measures so.
std::string metres_command(double unit_m, const std::string& crs, const std::string& path) {
  const bool is_in_feet = length_unit_m(crs) != 1;
  const std::string plan = crs_code(crs);
  const bool is_named = plan.starts_with("EPSG:");
  if (!is_named || (height_crs(crs).empty() && !is_in_feet)) return scale_command(unit_m, "", path);
  return scale_command(unit_m, plan + (is_in_feet ? "+5703" : ""), path);
}

// The unit of the heights as the band says it; empty where it says none.
std::string said_unit(GDALRasterBand& band) {
  const char* const unit = band.GetUnitType();
  return unit == nullptr || is_no_unit(unit) ? std::string() : unit;
}

struct HeightSample {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void add(double z) { low = std::min(low, z), high = std::max(high, z); }
};

// Of some 256 x 256 cells, with the numbers of the file.
HeightSample sample_of(GDALDataset& dataset) {
  constexpr int most = 256;
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  const int n_cols = std::min(most, band.GetXSize()), n_rows = std::min(most, band.GetYSize());
  std::vector<double> values(static_cast<std::size_t>(n_rows) * static_cast<std::size_t>(n_cols));
  const GdalErrors errors;
  HeightSample sample;
  if (band.RasterIO(GF_Read, 0, 0, band.GetXSize(), band.GetYSize(), values.data(), n_cols, n_rows,
                    GDT_Float64, 0, 0, nullptr) != CE_None)
    return {};
  int has_nodata = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  for (const double z : values)
    if (std::isfinite(z) && !is_usual_nodata(z) && (has_nodata == 0 || z != nodata)) sample.add(z);
  return sample;
}

void check_band(GDALDataset& dataset, const std::string& path, bool has_heights) {
  check_one_band(dataset, path);
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  if (GDALDataTypeIsComplex(band.GetRasterDataType()))
    throw InputError({path}, "the band holds complex numbers, expected real ones");
  if (!has_heights) return;
  if (band.GetRasterDataType() == GDT_Byte)
    throw InputError({path},
                     "the values have 8 bits, 0 to 255, as the shades of a picture (a hillshade) "
                     "have; expected elevations",
                     "give the elevation model itself; if these are heights: " +
                         translate_command("-ot Float32", path, "heights.tif"));
  const std::string unit = said_unit(band);
  const double metres = metres_in(unit);
  if (unit.empty() || metres == 1) return;
  const HeightSample z = sample_of(dataset);
  std::vector<Reading> readings = {
      {"as metres", rise_words(z.low, z.high, 0), metres_command(1, "", path)}};
  if (metres > 0)
    readings.insert(readings.begin(),
                    {"as \"" + unit + "\"", rise_words(z.low * metres, z.high * metres, 0),
                     metres_command(metres, wkt_of(dataset.GetSpatialRef()), path)});
  else
    readings.push_back({"as feet", rise_words(z.low * foot_m, z.high * foot_m, 0),
                        metres_command(foot_m, "", path)});
  throw InputError(
      choice_of({path}, "the elevations are in \"" + unit + "\", expected metres", readings));
}

// Heights are in metres by the unit of the band (check_band), by the user's word, or by
// height_unit_m of the CRS; another unit that the CRS says is refused with it (check_crs).
void check_unit_of_heights(GDALDataset& dataset, const std::string& crs, const MapWindow& edges,
                           const std::string& path, const DemOptions& options) {
  if (!said_unit(*dataset.GetRasterBand(1)).empty() || !options.vertical_crs.empty()) return;
  if (height_unit_m(crs)) return;
  const HeightSample z = sample_of(dataset);
  const double unit_m = length_unit_m(crs);
  const double width = unit_m * std::max(edges.x_max - edges.x_min, edges.y_max - edges.y_min);
  throw InputError(
      choice_of_height_unit({path}, unit_m, z.low, z.high, width, metres_command(unit_m, crs, path),
                            "--vertical-crs EPSG:5703 (NAVD88), or the code of their system"));
}

// The lattice of the cell centres; refuses rasters that no TRN can be made of.
GridFrame frame_of_raster(GDALDataset& dataset, const std::string& path) {
  const std::array<double, 6> g = north_up_place(dataset, path, CellKind::heights);
  const int n_cols = dataset.GetRasterXSize(), n_rows = dataset.GetRasterYSize();
  const double width = g[1], height = -g[5], smaller = std::min(width, height);
  if (std::abs(width - height) * std::max(n_rows, n_cols) > lattice_tolerance * smaller)
    throw InputError(
        {path},
        "the cells are " + text(width, 10) + " by " + text(height, 10) + ", expected squares",
        warp_command(CellKind::heights, "-tr " + text(smaller, 6) + " " + text(smaller, 6), path,
                     "north_up.tif"));
  return {n_rows, n_cols, width, {g[0] + 0.5 * width, g[3] - 0.5 * width}};
}

// Outer edges of the cells; not finite where the raster has none.
MapWindow edges_of(GDALDataset& dataset) {
  std::array<double, 6> g{};
  if (dataset.GetGeoTransform(g.data()) != CE_None) return {NAN, NAN, NAN, NAN};
  std::vector<Vec3> corners;
  for (const int col : {0, dataset.GetRasterXSize()})
    for (const int row : {0, dataset.GetRasterYSize()})
      corners.emplace_back(g[0] + col * g[1] + row * g[2], g[3] + col * g[4] + row * g[5], 0);
  return window_of(corners);
}

bool is_finite(const MapWindow& w) { return std::isfinite(w.x_min + w.y_min + w.x_max + w.y_max); }

CPLStringList words_of(const std::vector<std::string>& words) {
  CPLStringList list;
  for (const std::string& word : words) list.AddString(word.c_str());
  return list;
}

// A virtual raster of elevations that says unknown cells by NaN, with a ring of them around: a
// value interpolated from it is unknown where an unknown cell has a share.
Dataset with_unknown_ring(GDALDataset& source, const std::string& name) {
  std::array<double, 6> g{};
  source.GetGeoTransform(g.data());
  const int n_cols = source.GetRasterXSize(), n_rows = source.GetRasterYSize();
  const auto exact = [](double value) { return text(value); };
  char* const escaped = CPLEscapeString(name.c_str(), -1, CPLES_XML);
  const std::string size =
      " xSize=\"" + std::to_string(n_cols) + "\" ySize=\"" + std::to_string(n_rows) + "\"/>";
  const std::string xml =
      "<VRTDataset rasterXSize=\"" + std::to_string(n_cols + 2) + "\" rasterYSize=\"" +
      std::to_string(n_rows + 2) + "\"><GeoTransform>" + exact(g[0] - g[1] - g[2]) + "," +
      exact(g[1]) + "," + exact(g[2]) + "," + exact(g[3] - g[4] - g[5]) + "," + exact(g[4]) + "," +
      exact(g[5]) +
      "</GeoTransform><VRTRasterBand dataType=\"Float64\" band=\"1\"><NoDataValue>nan</NoDataValue>"
      "<ComplexSource><SourceFilename relativeToVRT=\"0\">" +
      escaped + "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"0\" yOff=\"0\"" + size +
      "<DstRect xOff=\"1\" yOff=\"1\"" + size +
      "<UseMaskBand>true</UseMaskBand></ComplexSource></VRTRasterBand></VRTDataset>";
  CPLFree(escaped);
  return Dataset(GDALDataset::Open(xml.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
}

Dataset warp(GDALDataset& source, const std::string& path, const CrsOperation& operation,
             const std::vector<std::string>& more) {
  std::vector<std::string> words = {"-of",    "VRT",        "-r",         "bilinear",
                                    "-et",    "0",          "-dstnodata", "nan",
                                    "-ot",    "Float64",    "-s_srs",     operation.from,
                                    "-t_srs", operation.to, "-ct",        operation.text};
  words.insert(words.end(), more.begin(), more.end());
  GdalErrors errors;
  GDALWarpAppOptions* const options = GDALWarpAppOptionsNew(words_of(words).List(), nullptr);
  GDALDatasetH handle = &source;
  Dataset warped(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &handle, options, nullptr)));
  GDALWarpAppOptionsFree(options);
  if (!warped)
    throw InputError(
        {path}, "cannot be reprojected to " + crs_name(operation.to) + ": " + errors.failure());
  return warped;
}

// A virtual raster that reprojects the rows read from it. Exact transformation (-et 0): the default
// eighth of a cell is a metre of height on a steep slope. Both systems are in plan alone: heights
// stay as they are. The cells are those that GDAL proposes for the raster without its ring.
Dataset reprojected(GDALDataset& source, GDALDataset& ringed, const std::string& path,
                    const CrsOperation& operation) {
  const Dataset proposed = warp(source, path, operation, {});
  std::array<double, 6> g{};
  proposed->GetGeoTransform(g.data());
  const int n_cols = proposed->GetRasterXSize(), n_rows = proposed->GetRasterYSize();
  return warp(ringed, path, operation,
              {"-srcnodata", "None", "-te", text(g[0]), text(g[3] + n_rows * g[5]),
               text(g[0] + n_cols * g[1]), text(g[3]), "-ts", std::to_string(n_cols),
               std::to_string(n_rows)});
}

// The command that makes metres of the plan and the heights of a local system; heights without a
// system are in the unit of the plan.
std::string local_metres_command(const std::string& crs, const MapWindow& w,
                                 const std::string& path) {
  const double unit_m = length_unit_m(crs);
  const auto metres = [unit_m](double value) { return text(value * unit_m, 12); };
  return translate_command("-a_srs 'LOCAL_CS[\"metres\",UNIT[\"metre\",1]]' -a_ullr " +
                               metres(w.x_min) + " " + metres(w.y_max) + " " + metres(w.x_max) +
                               " " + metres(w.y_min) + " -ot Float64 -scale 0 10000 0 " +
                               text(10000 * height_unit_m(crs).value_or(unit_m), 12),
                           path, "metres.tif");
}

void check_crs(const std::string& crs, const std::string& path, const MapWindow& edges,
               bool has_options) {
  if (crs.empty()) return;
  const Vec2 place(0.5 * (edges.x_min + edges.x_max), 0.5 * (edges.y_min + edges.y_max));
  const CrsProblem problem = find_crs_problem(crs, place);
  if (problem.finding.empty()) return;
  if (problem.height_unit_m != 1)
    throw InputError({path}, problem.finding, metres_command(problem.height_unit_m, crs, path));
  if (is_local(crs))
    throw InputError(
        {path}, problem.finding,
        "metres of plan and heights, for --crs none: " + local_metres_command(crs, edges, path));
  const std::string to = problem.mend_to.empty() ? "EPSG:code" : problem.mend_to;
  throw InputError({path}, problem.finding,
                   has_options
                       ? "--t-srs " + to + " reprojects"
                       : warp_command(CellKind::heights, "-t_srs " + to, path, "projected.tif"));
}

}  // namespace

DemFile::DemFile(const std::string& path, const DemOptions& options)
    : path_(path), has_heights_(options.has_heights) {
  open();
  GDALDataset* dataset = source_.get();
  if (options.accepts_doubts || !options.has_heights) accepts_doubts_ = true;
  const MapWindow edges = edges_of(*dataset);
  crs_ = with_heights_said(
      crs_said({path, wkt_of(dataset->GetSpatialRef()), edges, options.crs_may_be_missing}, options,
               reading_.notes),
      options, path);
  if (!options.t_srs.empty()) {
    check_unit_of_heights(*dataset, crs_, edges, path, options);
    if (crs_.empty())
      throw InputError({path}, "there is no CRS to reproject from", "name it with --crs EPSG:code");
    take_to(options.t_srs, options.accept_ballpark, edges);
    if (warped_) dataset = warped_.get();
  }
  check_crs(crs_, path, edges_of(*dataset), !options.crs_may_be_missing);
  frame_ = frame_of_raster(*dataset, path);
  if (!warped_) {
    const MapWindow read = intersection(edges, options.window);
    const bool is_beside = read.x_min > read.x_max || read.y_min > read.y_max;
    check_place_of(is_beside ? edges : read, crs_, !options.crs_may_be_missing);
  }
  take_heights_to(options);
  band_ = dataset->GetRasterBand(1);
  scale_ = source_->GetRasterBand(1)->GetScale();
  offset_ = source_->GetRasterBand(1)->GetOffset();
}

// An alpha band becomes the mask of the elevations.
void DemFile::open() {
  source_ = open_raster(path_);
  name_ = source_->GetDescription();
  check_band(*source_, path_, has_heights_);
  check_placed(*source_, path_, has_heights_ ? CellKind::heights : CellKind::values);
  const std::string masked = with_alpha_as_mask(*source_);
  if (masked.empty()) return;
  int has_nodata = 0;
  const double value = source_->GetRasterBand(1)->GetNoDataValue(&has_nodata);
  if (has_nodata != 0) nodata_ = value;
  name_ = masked;
  const GdalErrors errors;
  source_.reset(GDALDataset::Open(name_.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
  if (!source_) throw InputError({path_}, "its alpha band cannot be read: " + errors.failure());
}

void DemFile::check_place_of(const MapWindow& edges, const std::string& work_crs,
                             bool has_options) {
  if (crs_.empty() || !is_finite(edges)) return;
  CrsExtent place{crs_, edges, work_crs};
  place.has_crs_option = has_options;
  place.is_raster = true;
  check_place(place, {path_}, reading_.doubts);
}

// Reprojects in plan, unless it is there already.
void DemFile::take_to(const std::string& target, bool accept_ballpark, const MapWindow& edges) {
  const std::string wanted = with_heights_of(crs_, target, {path_});
  if (same_crs(crs_, target)) return;
  check_place_of(edges, target, true);
  const CrsOperation operation = plan_operation(crs_, target, edges, {path_}, accept_ballpark,
                                                reading_.notes, reading_.doubts);
  ringed_ = with_unknown_ring(*source_, name_);
  if (!ringed_) throw InputError({path_}, "cannot be reprojected");
  warped_ = reprojected(*source_, *ringed_, path_, operation);
  crs_ = wanted;
}

void DemFile::take_heights_to(const DemOptions& options) {
  to_vertical_ = height_operation(crs_, options, extent(frame_), path_);
  if (!to_vertical_) return;
  reading_.notes.push_back(path_ + ": " + to_vertical_->sentence());
  crs_ = with_heights(horizontal_crs(crs_), options.t_vertical, {path_});
}

bool DemFile::accepts_doubts() const {
  if (!accepts_doubts_) accepts_doubts_ = were_heights_judged(path_);
  return *accepts_doubts_;
}

Where DemFile::where(std::size_t index, int row, int col, int n_cols) const {
  const int r = row + static_cast<int>(index / static_cast<std::size_t>(n_cols));
  const int c = col + static_cast<int>(index % static_cast<std::size_t>(n_cols));
  return {path_, 0,
          "row " + std::to_string(r) + ", column " + std::to_string(c) + " (" +
              text(frame_.x(c), 10) + ", " + text(frame_.y(r), 10) + ")"};
}

// Cells of a strip above every summit, most of them or of many values: numbers of a smaller unit.
void DemFile::check_most_values(const double* raw, std::size_t n) const {
  constexpr std::size_t few = 4;  // values that stand for nodata
  std::size_t n_known = 0, n_beyond = 0;
  std::set<double> beyond;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = raw[i] * scale_ + offset_;
    if (std::isnan(z) || raw[i] == nodata_ || is_usual_nodata(raw[i])) continue;
    ++n_known;
    if (std::abs(z) > highest_elevation) {
      ++n_beyond;
      if (beyond.size() <= few) beyond.insert(z);
    }
    low = std::min(low, z), high = std::max(high, z);
  }
  if ((2 * n_beyond <= n_known && beyond.size() <= few) || low == high) return;
  const double width = frame_.cell_size * (std::max(frame_.n_rows, frame_.n_cols) - 1);
  throw InputError(choice_of(
      {path_}, "the elevations are " + text(low, 8) + " to " + text(high, 8) + ", expected metres",
      smaller_units(low, high, width,
                    [&](double unit_m) { return metres_command(unit_m, crs_, path_); })));
}

void DemFile::check_value(double raw, const Where& place) const {
  const double z = raw * scale_ + offset_;
  if (std::abs(z) <= highest_elevation && !is_usual_nodata(raw)) return;
  throw InputError(place,
                   "the elevation is " + text(z, 10) +
                       " m, which the file does not declare as "
                       "nodata",
                   "if it stands for nodata: " +
                       translate_command("-a_nodata " + text(raw), path_, "declared.tif"));
}

void DemFile::read(int row, int n_rows, int col, int n_cols, double* elevation) const {
  const std::size_t n = static_cast<std::size_t>(n_rows) * static_cast<std::size_t>(n_cols);
  const GdalErrors errors;
  std::vector<unsigned char> mask;
  const int mask_flags = band_->GetMaskFlags();
  // half transparent cells hold values that are mixed with unknown ones
  const unsigned char least_known = (mask_flags & GMF_ALPHA) != 0 ? 255 : 1;
  CPLErr status = band_->RasterIO(GF_Read, col, row, n_cols, n_rows, elevation, n_cols, n_rows,
                                  GDT_Float64, 0, 0, nullptr);
  if (status == CE_None && mask_flags != GMF_ALL_VALID) {
    mask.resize(n);
    status = band_->GetMaskBand()->RasterIO(GF_Read, col, row, n_cols, n_rows, mask.data(), n_cols,
                                            n_rows, GDT_Byte, 0, 0, nullptr);
  }
  if (status != CE_None || errors.failed()) {
    const bool names_other_format = errors.failure().find("not recognized") != std::string::npos;
    throw InputError({path_},
                     "reading rows " + std::to_string(row) + " to " +
                         std::to_string(row + n_rows - 1) + " of " +
                         size_text(frame_.n_rows, frame_.n_cols) + " failed: " + errors.failure(),
                     names_other_format
                         ? "make one file of it: " + translate_command("", path_, "one.tif")
                         : way_to_read(path_, "the file is damaged or cut short: fetch it again"));
  }
  for (std::size_t i = 0; i < n; ++i) {
    double& z = elevation[i];
    if (std::isnan(z) || z == nodata_ || (!mask.empty() && mask[i] < least_known)) {
      z = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    if (has_heights_ && !(std::abs(z) <= highest_elevation)) {
      if (z > highest_elevation) check_most_values(elevation + i, n - i);
      check_value(z, where(i, row, col, n_cols));
    }
    if (scale_ != 1 || offset_ != 0) z = z * scale_ + offset_;
  }
  if (to_vertical_) shift_heights(row, n_rows, col, n_cols, elevation);
}

void DemFile::shift_heights(int row, int n_rows, int col, int n_cols, double* elevation) const {
  const auto n = static_cast<std::size_t>(n_cols);
  std::vector<double> x(n), y(n);
  for (int c = 0; c < n_cols; ++c) x[c] = frame_.x(col + c);
  for (int r = 0; r < n_rows; ++r) {
    std::fill(y.begin(), y.end(), frame_.y(row + r));
    to_vertical_->apply(n, x.data(), y.data(), elevation + static_cast<std::size_t>(r) * n);
  }
}

namespace {

// Calls visit(row) for each row of the DEM that `part` needs, in order.
template <class Visit>
void for_each_row(const DemFile& dem, const RowResampler& part, const ProgressFunction& progress,
                  const Visit& visit) {
  const int first = part.first_row(), last = part.last_row();
  const auto n_cols = static_cast<std::size_t>(part.n_cols());
  constexpr double bytes_per_cell = 16;  // as read, and as GDAL keeps it
  require_memory(bytes_per_cell * rows_at_once * static_cast<double>(n_cols), {dem.path()},
                 "rows of " + std::to_string(n_cols) + " cells", "choose a smaller window");
  std::vector<double> strip(rows_at_once * n_cols);
  for (int row = first, n_rows = 0; row <= last; row += n_rows) {
    // strips end where rows of tiles do, so that no tile is unpacked twice
    n_rows = std::min(rows_at_once - row % rows_at_once, last - row + 1);
    dem.read(row, n_rows, part.first_col(), part.n_cols(), strip.data());
    for (int i = 0; i < n_rows; ++i) visit(strip.data() + static_cast<std::size_t>(i) * n_cols);
    if (progress) progress(static_cast<double>(row + n_rows - first) / (last - first + 1));
  }
}

// Refuses an area of one value that differs much from the cells beside it.
void refuse_lone_level(const DemFile& dem, const RowResampler& part,
                       const std::set<double>& values) {
  const double step = impossible_step(dem.frame().cell_size);
  LoneLevels levels(part.n_cols(), step, values);
  for_each_row(dem, part, {}, [&](const double* row) { levels.add_row(row); });
  const std::optional<LoneLevel> found = levels.worst();
  if (!found) return;
  const int row = part.first_row() + found->row, col = part.first_col() + found->col;
  throw InputError(
      dem.where_of_cell(row, col),
      "the elevation is " + text(found->value, 10) + " m in " + counted(found->n_cells, "cell") +
          " side by side, more than " + text(step, 6) + " m off " + std::to_string(found->n_far) +
          " of the " + std::to_string(found->n_beside) +
          " beside them, and the file does not declare it as nodata (talus-trn "
          "--accept-doubts takes it as ground, make TRN_FLAGS=--accept-doubts)",
      "if it stands for nodata: " + translate_command("-a_nodata " + text(dem.raw_of(found->value)),
                                                      dem.path(), "declared.tif"));
}

}  // namespace

std::vector<double> read_dem(const DemFile& dem, const GridFrame& frame,
                             const ProgressFunction& progress) {
  RowResampler resampler(dem.frame(), frame);
  if (resampler.first_row() > resampler.last_row() || resampler.n_cols() < 1)
    return resampler.take();
  StepFinder steps(resampler.n_cols(), impossible_step(dem.frame().cell_size));
  for_each_row(dem, resampler, progress, [&](const double* row) {
    steps.add_row(row);
    resampler.add_row(row);
  });
  if (!steps.values().empty() && !dem.accepts_doubts())
    refuse_lone_level(dem, resampler, steps.values());
  return resampler.take();
}

Trn read_trn(const std::string& path) {
  DemOptions options;
  options.crs_may_be_missing = true;
  const DemFile dem(path, options);
  check_size(dem.frame(), path);
  Trn trn = make_trn(dem.frame(), dem.crs_wkt(), read_dem(dem, dem.frame()));
  check_trn(trn, path);
  trn.dams = burnt_dams(path, trn);
  return trn;
}

}  // namespace talus
