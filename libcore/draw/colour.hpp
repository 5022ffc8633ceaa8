// libcore/draw/colour.hpp: public
// Colours of pictures, styles and legends.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace talus {

using Colour = std::array<std::uint8_t, 4>;  ///< red, green, blue, alpha

/// 0xRRGGBB, opaque or with an alpha.
[[nodiscard]] constexpr Colour rgb(std::uint32_t bits, std::uint8_t alpha = 255) {
  return {static_cast<std::uint8_t>(bits >> 16 & 255), static_cast<std::uint8_t>(bits >> 8 & 255),
          static_cast<std::uint8_t>(bits & 255), alpha};
}

/// "#rrggbb" or "#rgb"; transparent where it is neither.
[[nodiscard]] Colour colour_of(const std::string& hex);

}  // namespace talus
