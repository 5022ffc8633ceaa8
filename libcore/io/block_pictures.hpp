// libcore/io/block_pictures.hpp: public
// Pictures of a block set as SVG text: the stereonet of its joints, the curve of its sizes.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// A joint set on the stereonet.
struct NetSet {
  std::string name;
  Vec3 mean = Vec3::UnitZ();  ///< upward pole
  std::vector<Vec3> poles;    ///< of the planes drawn or measured
};

/// Equal-area (Schmidt) net of the lower hemisphere: poles as dots, the mean plane of each set as a
/// great circle, and the mean direction and dip of the slope when `slope_normal` is not zero.
[[nodiscard]] std::string stereonet_svg(const std::vector<NetSet>& sets, const Vec3& slope_normal);

/// Share of the volume in blocks smaller than V against V, logarithmic, with V10, V50, V90 marked.
[[nodiscard]] std::string size_curve_svg(std::vector<double> volumes);

/// Volume below which a share of the total volume lies [m3]: V10 for share 0.1. `sorted` ascending,
/// not empty.
[[nodiscard]] double volume_quantile(const std::vector<double>& sorted, double share);

}  // namespace talus
