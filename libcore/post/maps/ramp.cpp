// Colour ramps of maps.
#include "post/maps/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus {
namespace {

// 0xRRGGBB at equal steps from share 0 to share 1.
const std::vector<std::uint32_t>& stops_of(Ramp ramp) {
  static const std::vector<std::uint32_t>
      speed = {0xedf8b1, 0xc7e9b4, 0x7fcdbb, 0x41b6c4, 0x1d91c0, 0x225ea8, 0x253494, 0x081d58},
      energy = {0xffeda0, 0xfed976, 0xfeb24c, 0xfd8d3c, 0xfc4e2a,
                0xe31a1c, 0xbd0026, 0x800026, 0x400020},
      height = {0xece2f0, 0xd0d1e6, 0xa6bddb, 0x67a9cf, 0x3690c0, 0x02818a, 0x016c59, 0x014636},
      probability = {0xe0ecf4, 0xbfd3e6, 0x9ebcda, 0x8c96c6,
                     0x8c6bb1, 0x88419d, 0x810f7c, 0x4d004b},
      thickness = {0xfff7bc, 0xfee391, 0xfec44f, 0xfe9929, 0xec7014, 0xcc4c02, 0x993404, 0x662506},
      time = {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
              0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725},
      angle = {0x00224e, 0x123570, 0x3b496c, 0x575d6d, 0x707173,
               0x8a8678, 0xa59c74, 0xc3b369, 0xe1cc55, 0xfee838},
      frequency = {0xe7e1ef, 0xd4b9da, 0xc994c7, 0xdf65b0, 0xe7298a, 0xce1256, 0x980043, 0x67001f},
      intensity = {0xe5f5e0, 0xc7e9c0, 0xa1d99b, 0x74c476, 0x41ab5d, 0x238b45, 0x006d2c, 0x00441b},
      less = {0xd1e5f0, 0x92c5de, 0x4393c3, 0x2166ac, 0x053061},
      more = {0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b, 0x67001f};
  switch (ramp) {
    case Ramp::speed:
      return speed;
    case Ramp::energy:
      return energy;
    case Ramp::height:
      return height;
    case Ramp::probability:
      return probability;
    case Ramp::thickness:
      return thickness;
    case Ramp::time:
      return time;
    case Ramp::angle:
      return angle;
    case Ramp::frequency:
      return frequency;
    case Ramp::intensity:
      return intensity;
    case Ramp::less:
      return less;
    case Ramp::more:
      break;
  }
  return more;
}

}  // namespace

Colour ramp_colour(Ramp ramp, double share) {
  const std::vector<std::uint32_t>& stops = stops_of(ramp);
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(place), stops.size() - 2);
  const double s = place - static_cast<double>(i);
  Colour colour{0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto part = [&](std::uint32_t rgb) {
      return static_cast<double>((rgb >> (16 - 8 * k)) & 0xff);
    };
    colour[k] = static_cast<std::uint8_t>(
        std::lround(part(stops[i]) + s * (part(stops[i + 1]) - part(stops[i]))));
  }
  return colour;
}

}  // namespace talus
