// libcore/import/crs_operation_gdal.hpp: public
// The one coordinate operation by which points are taken from a system to another.
// in:    two systems, and the part of the map that is taken
// out:   the best operation that this machine can carry out, with its name and accuracy; never one
//        that PROJ only guesses ("ballpark") unless the user accepts that
// refs:  ISO 19111 (coordinate operations); PROJ, proj_create_operations
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"
#include "terrain/grid_frame.hpp"

class OGRCoordinateTransformation;

namespace talus {

/// How coordinates are taken from one system to another.
struct CrsOperation {
  std::string from, to;  ///< WKT
  std::string text;      ///< PROJ string or WKT, with the axes as the authority has them
  std::string name;      ///< "Inverse of UTM zone 33N + UTM zone 32N"
  double accuracy_m = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
  bool is_ballpark = false;  ///< two datums are taken for the same one: the user accepted that
  std::string better_grid;   ///< of a better operation, which is not installed; empty: none
  double better_accuracy_m = std::numeric_limits<double>::quiet_NaN();
};

/// The best operation in plan for data in `window` (coordinates of `from`). Throws InputError
/// at `where` when there is none but a ballpark one and that is not accepted: the finding names the
/// grid that is missing, or the system whose datum is not known.
[[nodiscard]] CrsOperation find_operation(const std::string& from, const std::string& to,
                                          const MapWindow& window, const Where& where,
                                          bool accept_ballpark = false);

/// Takes points in plan, x (east, longitude) first; heights stay. False when a point cannot be
/// taken; `points` are then spoilt.
[[nodiscard]] bool carry_out(const CrsOperation& operation, std::vector<Vec3>& points);

/// "reprojected from A to B by "MGI to ETRS89 (1)", good to 1.5 m".
[[nodiscard]] std::string sentence_on(const CrsOperation& operation);

/// Warning: a ballpark operation, or a better one whose grid is missing. Empty: nothing.
[[nodiscard]] std::string doubt_on(const CrsOperation& operation);

/// Heights taken from one system to another, at places of one system in plan.
class HeightOperation {
 public:
  /// `from` and `to` are vertical systems (WKT), or `from` is ellipsoidal_heights. Always the best
  /// operation that PROJ knows: throws InputError at `where` when its grid is missing or there is
  /// none, so that heights are the same on every machine.
  HeightOperation(const std::string& plan_wkt, const std::string& from, const std::string& to,
                  const MapWindow& window, Where where);

  /// New heights of n places; NaN stays NaN. Throws InputError with the place where the grid ends.
  void apply(std::size_t n, const double* x, const double* y, double* z) const;
  void apply(std::vector<Vec3>& points) const;
  /// "heights taken from A to B by "WGS 84 to EGM96 height (1)", good to 1 m".
  [[nodiscard]] const std::string& sentence() const { return sentence_; }

 private:
  void add(const std::string& from, const std::string& to, const std::string& name,
           const std::string& operation);

  std::vector<std::shared_ptr<OGRCoordinateTransformation>> steps_;
  std::string sentence_;
  Where where_;
};

/// Stands for heights above the ellipsoid of the system in plan.
inline constexpr const char* ellipsoidal_heights = "ellipsoidal";

/// A vertical system that a user names: WKT of "EPSG:5773", or ellipsoidal_heights. Throws
/// InputError that names `option` when it is another kind of system or not in metres.
[[nodiscard]] std::string vertical_crs_from_user(const std::string& user_text,
                                                 const std::string& option);

/// The same for a system that heights are to be taken to: ellipsoidal_heights is refused, since the
/// outputs could not say it.
[[nodiscard]] std::string target_heights_from_user(const std::string& user_text,
                                                   const std::string& option);

/// Name of heights in a message.
[[nodiscard]] std::string heights_name(const std::string& vertical_wkt);

/// `crs` with heights in the system that the user states (WKT, or ellipsoidal_heights, which
/// leaves `crs` as it is). Throws InputError when `crs` says another system of heights.
[[nodiscard]] std::string with_stated_heights(const std::string& crs, const std::string& vertical,
                                              const Where& where);

/// The system that heights are in: WKT, or ellipsoidal_heights for a system of three axes. Throws
/// InputError when `crs` does not say it.
[[nodiscard]] std::string stated_heights(const std::string& crs, const Where& where);

/// Whether two systems of heights are the same one.
[[nodiscard]] bool same_system(const std::string& vertical_a, const std::string& vertical_b);

}  // namespace talus
