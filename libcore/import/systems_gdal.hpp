// libcore/import/systems_gdal.hpp
// The systems of a file's coordinates and heights: those that it names, or that the user says; and
// the operations to other systems. One rule for layers, elevation models and TINs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "import/crs_operation_gdal.hpp"
#include "import/request.hpp"

namespace talus {

inline constexpr const char* way_to_name_crs =
    "name it with --crs EPSG:code, or --crs none for local metres";

/// A file, its own system, and the place of its coordinates.
struct FileInSystem {
  std::string path, crs;  ///< WKT; empty: the file says none
  MapWindow extent;
  bool crs_may_be_missing = false;  ///< no CRS and none given means local metres
  bool is_reprojected = true;       ///< a TIN is not
};

/// WKT; empty for local metres. The user's system takes the place of one that is missing, that says
/// no heights, or that cannot be true for data there; a note says why. Throws InputError where
/// there is none, or the file has another one.
[[nodiscard]] std::string crs_said(const FileInSystem& file, const SystemsByUser& said,
                                   std::vector<std::string>& notes);

/// `crs` with the heights that the user says of a file that does not. Throws InputError where it
/// does.
[[nodiscard]] std::string with_heights_said(const std::string& crs, const SystemsByUser& said,
                                            const std::string& path);

/// The operation in plan for data in `window`, with a sentence for `notes`. Throws InputError
/// as find_operation().
[[nodiscard]] CrsOperation plan_operation(const std::string& from, const std::string& to,
                                          const MapWindow& window, const Where& where,
                                          bool accept_ballpark, std::vector<std::string>& notes,
                                          std::vector<Doubt>& doubts);

/// The operation that takes heights, which are in `crs`, to the system asked for; null where none
/// is asked for or needed. Throws InputError where their system is unknown.
[[nodiscard]] std::unique_ptr<HeightOperation> height_operation(const std::string& crs,
                                                                const SystemsByUser& said,
                                                                const MapWindow& window,
                                                                const std::string& path);

/// Throws InputError, with the option that reprojects, where a system cannot be computed in.
void check_can_be_computed_in(const std::string& crs, const Vec3& place, const std::string& path);

}  // namespace talus
