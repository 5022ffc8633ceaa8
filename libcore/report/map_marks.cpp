#include "report/map_marks.hpp"

#include <cmath>

#include "base/text.hpp"

namespace talus {
namespace {

std::string number(double value) { return text(std::round(value * 100) / 100); }

}  // namespace

std::string scale_and_north(const Vec2& low, const Vec2& high) {
  const double width = high.x() - low.x(), unit = width / 100;
  double length = std::pow(10, std::floor(std::log10(width / 4)));
  for (const double factor : {5.0, 2.0})
    if (factor * length <= width / 4) {
      length *= factor;
      break;
    }
  const double x = low.x() + 3 * unit, y = high.y() - 3 * unit;
  const double north_x = high.x() - 5 * unit, north_y = low.y() + 10 * unit;
  return "<g font-size=\"" + number(2.6 * unit) + "\" class=\"marks\">" + "<path d=\"M" +
         number(x) + " " + number(y - unit) + "v" + number(unit) + "h" + number(length) + "v" +
         number(-unit) + "\" fill=\"none\" stroke=\"#000\" stroke-width=\"" + number(0.35 * unit) +
         "\"/><text x=\"" + number(x + length + unit) + "\" y=\"" + number(y) + "\">" +
         text(length) + " m</text><path d=\"M" + number(north_x) + " " + number(north_y) + "l" +
         number(1.6 * unit) + " " + number(0.8 * unit) + "l" + number(-1.6 * unit) + " " +
         number(-6 * unit) + "l" + number(-1.6 * unit) + " " + number(6 * unit) +
         "z\"/><text text-anchor=\"middle\" x=\"" + number(north_x) + "\" y=\"" +
         number(north_y - 6 * unit) + "\">N</text></g>\n";
}

}  // namespace talus
