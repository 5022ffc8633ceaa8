// libcore/io/block_pictures.hpp: public
// Pictures of a block set: the stereonet of its joints, the curve of its sizes.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"
#include "draw/chart.hpp"

namespace talus {

/// A joint set on the stereonet.
struct NetSet {
  std::string name;
  Vec3 mean = Vec3::UnitZ();  ///< upward pole
  std::vector<Vec3> poles;    ///< of the planes drawn or measured
};

/// Where planes and lines are free to move out of a slope.
struct NetZones {
  double slope = 0, aspect = 0;              ///< of the mean face [rad]
  double friction = 0;                       ///< [rad]
  double lateral = 0, toppling_lateral = 0;  ///< limits beside the fall line [rad]
};
/// A line of intersection of two sets.
struct NetLine {
  std::string name;
  Vec3 direction = Vec3::UnitZ();
  bool is_free = false;  ///< ringed
};

/// Equal-area (Schmidt) net of the lower hemisphere: poles as dots, the mean plane of each set as a
/// great circle, and the mean direction and dip of the slope when `slope_normal` is not zero.
[[nodiscard]] Drawing stereonet(const std::vector<NetSet>& sets, const Vec3& slope_normal);

/// The same with the zones of poles that slide (daylight envelope, friction circle, lateral limits)
/// and topple (slip limit plane), and with the lines of pairs of sets.
[[nodiscard]] Drawing kinematic_net(const std::vector<NetSet>& sets, const Vec3& slope_normal,
                                    const NetZones& zones, const std::vector<NetLine>& lines);

/// Share of the volume in blocks smaller than V against V, logarithmic, with V10, V50, V90 marked.
[[nodiscard]] Chart size_curve(std::vector<double> volumes);

/// Volume below which a share of the total volume lies [m3]: V10 for share 0.1. `sorted` ascending,
/// not empty.
[[nodiscard]] double volume_quantile(const std::vector<double>& sorted, double share);

}  // namespace talus
