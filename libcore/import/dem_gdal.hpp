// libcore/import/dem_gdal.hpp: public
// Elevation rasters: any GDAL raster read as rows of node elevations, the TRN among them.
// in:    single-band rasters, north-up, square cells, projected in metres
// out:   rows of elevations, Trn
//
// The nodes are the centres of the raster's cells, whatever AREA_OR_POINT says: GDAL's geotransform
// has the half cell of a Point raster in it already.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "import/crs_operation_gdal.hpp"
#include "import/request.hpp"
#include "io/raster_bands_gdal.hpp"
#include "terrain/grid_frame.hpp"

class GDALRasterBand;

namespace talus {

/// The user's statements about a DEM. It is reprojected bilinearly, at the file's resolution; where
/// an unknown cell has a share, the value is unknown.
struct DemOptions : SystemsByUser {
  bool accepts_doubts = false;      ///< areas of one value far off their neighbours are ground
  bool crs_may_be_missing = false;  ///< no CRS and none given means local metres
  bool has_heights = true;          ///< false: other numbers, to which no rule of heights applies
  /// Part that is read, in map coordinates: only this must lie where the CRS is used. Not looked at
  /// with t_srs.
  MapWindow window{-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL};
};

/// Report of reading.
struct DemReading {
  std::vector<std::string> notes;  ///< sentences: which operation took it to another system
  std::vector<Doubt> doubts;
};

/// An open elevation raster. Reads only the requested rows, so that it may be larger than memory.
class DemFile {
 public:
  /// Throws InputError when the raster cannot be opened, holds several rasters, has not exactly one
  /// band of real numbers (an alpha band beside it is its mask), is rotated, not north-up or not
  /// square (by more than 1e-3 of a cell at its far end), is not in projected metres, lies where
  /// its CRS is not used (check_place), has elevations in another unit, or when the options
  /// contradict it. The hint holds the command that mends it.
  explicit DemFile(const std::string& path, const DemOptions& options = {});
  DemFile(const DemFile&) = delete;
  DemFile& operator=(const DemFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const GridFrame& frame() const { return frame_; }    ///< its cell centres
  [[nodiscard]] const std::string& crs_wkt() const { return crs_; }  ///< empty for local metres
  [[nodiscard]] const DemReading& reading() const { return reading_; }
  /// By the options, or because the file's heights were judged (judged_heights_gdal.hpp).
  [[nodiscard]] bool accepts_doubts() const;
  /// The number in the file for an elevation.
  [[nodiscard]] double raw_of(double z) const { return (z - offset_) / scale_; }
  /// With its place on the map.
  [[nodiscard]] Where where_of_cell(int row, int col) const {
    return where(0, row, col, frame_.n_cols);
  }

  /// Elevations of n_rows x n_cols nodes from (row, col) on, NaN = unknown [m]. Throws InputError
  /// with the place for a file that ends early and for values that are not elevations: infinite,
  /// beyond +-9,000 m, or one of the usual nodata values while the file declares another or none.
  void read(int row, int n_rows, int col, int n_cols, double* elevation) const;

 private:
  [[nodiscard]] Where where(std::size_t index, int row, int col, int n_cols) const;
  void open();
  void check_value(double raw, const Where& place) const;
  void check_most_values(const double* raw, std::size_t n) const;
  void check_place_of(const MapWindow& edges, const std::string& work_crs, bool has_options);
  void take_to(const std::string& target, bool accept_ballpark, const MapWindow& edges);
  void take_heights_to(const DemOptions& options);
  void shift_heights(int row, int n_rows, int col, int n_cols, double* elevation) const;

  std::string path_, crs_;
  std::string name_;              ///< that GDAL opens: the path, or a virtual raster
  double nodata_ = std::nan("");  ///< beside a mask, which GDAL prefers
  GridFrame frame_;
  DemReading reading_;
  std::unique_ptr<HeightOperation> to_vertical_;
  Dataset source_, ringed_, warped_;  ///< warped reads from ringed and is closed first
  GDALRasterBand* band_ = nullptr;
  double scale_ = 1, offset_ = 0;
  bool has_heights_ = true;
  mutable std::optional<bool> accepts_doubts_;  ///< asked once: it may take a look at all heights
};

/// The TRN of a GeoTIFF written by write_trn(), or of any raster that DemFile takes: its cell
/// centres become nodes as they are. A missing CRS is left empty. Throws InputError (DemFile,
/// check_trn).
[[nodiscard]] Trn read_trn(const std::string& path);

/// Elevations of `dem` on the nodes of `frame`, which is in the CRS of `dem`: area-weighted means
/// where the cell grows, bilinear where it shrinks, copies where the nodes are the DEM's own
/// (RowResampler). Reads the rows and columns that the frame needs, strip by strip. Throws
/// InputError for an area of one value far off its neighbours (lone_levels.hpp), unless the DEM
/// accepts doubts.
[[nodiscard]] std::vector<double> read_dem(const DemFile& dem, const GridFrame& frame,
                                           const ProgressFunction& progress = {});

}  // namespace talus
