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

}  // namespace talus
