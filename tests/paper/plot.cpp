#include "paper/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace talus {
namespace {

constexpr double width = 640, height = 440;                       // of the picture [px]
constexpr double left = 70, right = 620, top = 40, bottom = 390;  // of the axes [px]

struct Axis {
  double low, high;  // of the axis, in its own numbers
  double from, to;   // where these stand [px]
  bool logarithmic = false;
  [[nodiscard]] double at(double value) const {
    if (logarithmic) value = std::log10(value);
    return from + (value - low) / (high - low) * (to - from);
  }
};

// 1, 2 or 5 times a power of ten, so that about six steps fill the range.
double round_step(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 6)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (range / (factor * power) <= 8) return factor * power;
  return 10 * power;
}

Axis axis_of(const Figure& figure, int k, double from, double to) {
  Axis axis{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), from,
            to, k == 0 && figure.logarithmic_x};
  for (const Curve& curve : figure.curves)
    for (const Vec2& point : curve.points) {
      const double value = axis.logarithmic ? std::log10(point[k]) : point[k];
      axis.low = std::min(axis.low, value);
      axis.high = std::max(axis.high, value);
    }
  const double step = axis.logarithmic ? 1 : round_step(axis.high - axis.low);
  axis.low = step * std::floor(axis.low / step + 1e-9);
  axis.high = step * std::ceil(axis.high / step - 1e-9);
  return axis;
}

std::string number(double value) { return text(std::round(100 * value) / 100); }

std::string words(double x, double y, const std::string& content, const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" " + more + ">" + content +
         "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& colour) {
  return "<path d=\"M" + number(x1) + " " + number(y1) + "L" + number(x2) + " " + number(y2) +
         "\" stroke=\"" + colour + "\"/>\n";
}

std::string ticks(const Axis& x, const Axis& y) {
  std::string svg;
  const double step_x = x.logarithmic ? 1 : round_step(x.high - x.low);
  for (int i = 0; x.low + i * step_x <= x.high + 1e-9 * step_x; ++i) {
    const double value = x.low + i * step_x,
                 at = x.from + (value - x.low) / (x.high - x.low) * (x.to - x.from);
    svg += line(at, top, at, bottom, "#ddd");
    svg += words(at, bottom + 18, x.logarithmic ? "1e" + text(value) : text(value, 6),
                 "text-anchor=\"middle\"");
  }
  const double step_y = round_step(y.high - y.low);
  for (int i = 0; y.low + i * step_y <= y.high + 1e-9 * step_y; ++i) {
    const double value = y.low + i * step_y, at = y.at(value);
    svg += line(left, at, right, at, "#ddd");
    svg += words(left - 8, at + 4, text(std::round(1e9 * value) / 1e9, 6), "text-anchor=\"end\"");
  }
  return svg;
}

std::string drawn(const Curve& curve, const Axis& x, const Axis& y) {
  std::string svg;
  if (curve.markers) {
    for (const Vec2& point : curve.points)
      svg += "<circle cx=\"" + number(x.at(point.x())) + "\" cy=\"" + number(y.at(point.y())) +
             "\" r=\"3.2\" stroke=\"" + curve.colour + "\"/>\n";
    return svg;
  }
  svg = "<path stroke=\"" + curve.colour + "\" stroke-width=\"1.5\" d=\"";
  for (const Vec2& point : curve.points)
    svg += (&point == curve.points.data() ? "M" : "L") + number(x.at(point.x())) + " " +
           number(y.at(point.y()));
  return svg + "\"/>\n";
}

}  // namespace

std::string svg_of(const Figure& figure) {
  const Axis x = axis_of(figure, 0, left, right), y = axis_of(figure, 1, bottom, top);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) +
                    " " + number(height) +
                    "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"none\">\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<g fill=\"#222\">\n";
  svg += words((left + right) / 2, 22, figure.title, "text-anchor=\"middle\" font-size=\"14\"");
  svg += words((left + right) / 2, bottom + 40, figure.x_label, "text-anchor=\"middle\"");
  svg += words(-(top + bottom) / 2, 18, figure.y_label,
               "text-anchor=\"middle\" transform=\"rotate(-90)\"");
  svg += ticks(x, y) + "</g>\n";
  svg += "<rect x=\"70\" y=\"40\" width=\"550\" height=\"350\" stroke=\"#222\"/>\n";
  // The legend stands where the first curve does not begin.
  const Vec2& begin = figure.curves.front().points.front();
  const double side = y.at(begin.y()) < (top + bottom) / 2 ? right - 190 : left + 10;
  double row = top + 16;
  for (const Curve& curve : figure.curves) {
    svg += drawn(curve, x, y);
    if (curve.name.empty()) continue;
    svg += curve.markers ? "<circle cx=\"" + number(side + 10) + "\" cy=\"" + number(row - 4) +
                               "\" r=\"3.2\" stroke=\"" + curve.colour + "\"/>\n"
                         : line(side, row - 4, side + 20, row - 4, curve.colour);
    svg += words(side + 28, row, curve.name, "fill=\"#222\"");
    row += 16;
  }
  return svg + "</svg>\n";
}

}  // namespace talus
