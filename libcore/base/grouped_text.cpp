// Numbers as text for readers: digits in groups of three, no power of ten where digits can be read.
#include "base/grouped_text.hpp"

#include <cmath>

#include "base/text.hpp"

namespace talus {

std::string grouped_text(double value, int digits) {
  const double size = std::abs(value);
  if (!(size >= std::pow(10, digits) && size < 1e9)) return text(value, digits);
  const double unit = std::pow(10, std::floor(std::log10(size)) + 1 - digits);
  std::string out = std::to_string(std::llround(std::round(size / unit) * unit));
  for (std::size_t place = out.size(); place > 3; place -= 3) out.insert(place - 3, ",");
  return (value < 0 ? "-" : "") + out;
}

std::string needed_text(double value, int digits) {
  if (!(value > 0 && value < 1e9)) return grouped_text(value, digits);
  const double unit = std::pow(10, std::floor(std::log10(value)) + 1 - digits);
  return grouped_text(std::ceil(value / unit * (1 - 1e-12)) * unit, digits);
}

}  // namespace talus
