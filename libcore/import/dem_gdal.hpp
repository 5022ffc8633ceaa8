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
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "import/request.hpp"
#include "terrain/grid_frame.hpp"

namespace talus {

/// What the user says about a DEM. It is reprojected bilinearly, at the file's resolution; where an
/// unknown cell has a share, the value is unknown.
struct DemOptions : SystemsByUser {
  bool accepts_doubts = false;      ///< areas of one value that stand far off are ground
  bool crs_may_be_missing = false;  ///< no CRS and none given means local metres
  bool has_heights = true;          ///< false: other numbers, to which no rule of heights applies
  /// Part that is read, in map coordinates: only this must lie where the CRS is used. Not looked at
  /// with t_srs.
  MapWindow window{-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL};
};

/// What was done on the way in.
struct DemReading {
  std::vector<std::string> notes;     ///< sentences: which operation took it to another system
  std::vector<std::string> warnings;  ///< a place beside its CRS, a better operation without grid
};

/// An open elevation raster. Reads only what is asked for, so that it may be larger than memory.
class DemFile {
 public:
  /// Throws InputError when the raster cannot be opened, holds several rasters, has not exactly one
  /// band of real numbers (an alpha band beside it is its mask), is rotated, not north-up or not
  /// square (by more than 1e-3 of a cell at its far end), is not in projected metres, lies where
  /// its CRS is not used (check_place), has elevations in another unit, or when the options
  /// contradict it. The hint holds the command that mends it.
  explicit DemFile(const std::string& path, const DemOptions& options = {});
  ~DemFile();
  DemFile(const DemFile&) = delete;
  DemFile& operator=(const DemFile&) = delete;

  [[nodiscard]] const std::string& path() const;
  [[nodiscard]] const GridFrame& frame() const;      ///< its cell centres
  [[nodiscard]] const std::string& crs_wkt() const;  ///< empty for local metres
  [[nodiscard]] const DemReading& reading() const;
  /// By the options, or because the file's heights were judged (judged_heights_gdal.hpp).
  [[nodiscard]] bool accepts_doubts() const;
  [[nodiscard]] double raw_of(double z) const;  ///< what stands in the file for an elevation
  [[nodiscard]] Where where_of_cell(int row, int col) const;  ///< with its place on the map

  /// Elevations of n_rows x n_cols nodes from (row, col) on, NaN = unknown [m]. Throws InputError
  /// with the place for a file that ends early and for values that are no elevations: infinite,
  /// beyond +-9,000 m, or one of the usual nodata values while the file declares another or none.
  void read(int row, int n_rows, int col, int n_cols, double* elevation) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The TRN of a GeoTIFF written by write_trn(), or of any raster that DemFile takes: its cell
/// centres become nodes as they are. A missing CRS is left empty. Throws InputError (DemFile,
/// check_trn).
[[nodiscard]] Trn read_trn(const std::string& path);

/// Elevations of `dem` on the nodes of `frame`, which is in the CRS of `dem`: area-weighted means
/// where the cell grows, bilinear where it shrinks, copies where the nodes are the DEM's own
/// (RowResampler). Reads the rows and columns that the frame needs, strip by strip. Throws
/// InputError for an area of one value that stands far off what is beside it (lone_levels.hpp),
/// unless the DEM accepts doubts.
[[nodiscard]] std::vector<double> read_dem(const DemFile& dem, const GridFrame& frame,
                                           const ProgressFunction& progress = {});

}  // namespace talus
