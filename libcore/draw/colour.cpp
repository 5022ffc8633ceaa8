// Colours of pictures, styles and legends: reading, mixing, text.
#include "draw/colour.hpp"

namespace talus {

Colour colour_of(const std::string& hex) {
  std::uint32_t bits = 0;
  const bool is_short = hex.size() == 4;
  if ((hex.size() != 7 && !is_short) || hex[0] != '#') return {};
  for (std::size_t i = 1; i < hex.size(); ++i) {
    const std::size_t digit = std::string_view("0123456789abcdef").find(hex[i] | 32);
    if (digit > 15) return {};
    bits = is_short ? bits << 8 | static_cast<std::uint32_t>(17 * digit)
                    : bits << 4 | static_cast<std::uint32_t>(digit);
  }
  return rgb(bits);
}

}  // namespace talus
