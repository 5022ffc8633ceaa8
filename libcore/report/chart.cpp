#include "report/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "report/encode.hpp"

namespace talus {
namespace {

constexpr double width = 640, height = 300, left = 66, right = 14, top = 34, bottom = 44;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool is_empty() const { return !(low <= high); }
};

// A tick's number, written out where text() would take a power of ten.
std::string tick_text(double value) {
  const bool is_whole = value == std::round(value) && std::abs(value) < 1e9;
  return is_whole ? std::to_string(std::llround(value)) : text(value, 6);
}

std::string px(double value) { return text(std::round(value * 10) / 10); }

// Where values lie on the page; a logarithmic axis holds logarithms.
struct Frame {
  Range x, y;
  bool log_y = false;

  [[nodiscard]] bool is_drawn(double value_y) const {
    return std::isfinite(value_y) && (!log_y || value_y > 0);
  }
  [[nodiscard]] double scaled(double value_y) const {
    return log_y ? std::log10(value_y) : value_y;
  }
  [[nodiscard]] double at_x(double value) const {
    return left + (value - x.low) / (x.high - x.low) * (width - left - right);
  }
  [[nodiscard]] double at_y(double value) const {
    return height - bottom - (value - y.low) / (y.high - y.low) * (height - top - bottom);
  }
};

Frame frame_of(const Chart& chart) {
  Frame frame;
  frame.log_y = chart.log_y;
  for (const ChartSeries& line : chart.series)
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!std::isfinite(line.x[i]) || !frame.is_drawn(line.y[i])) continue;
      frame.x.add(line.x[i]);
      frame.y.add(frame.scaled(line.y[i]));
    }
  if (frame.x.is_empty()) frame.x = {0, 1}, frame.y = {0, 1};
  if (!chart.log_y && frame.y.low > 0 && frame.y.low < 0.5 * frame.y.high) frame.y.low = 0;
  if (frame.x.high <= frame.x.low) frame.x.high = frame.x.low + 1;
  const double least = std::max(1e-12, 1e-9 * std::abs(frame.y.high));
  if (frame.y.high - frame.y.low < least) frame.y.high = frame.y.low + (chart.log_y ? 1 : least);
  if (chart.log_y) frame.y = {std::floor(frame.y.low), std::ceil(frame.y.high)};
  return frame;
}

std::string label(double x, double y, const char* anchor, const std::string& words) {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\">" + words +
         "</text>\n";
}

std::string axes(const Chart& chart, const Frame& frame) {
  std::string out;
  for (const double tick : round_ticks(frame.x.low, frame.x.high, 6)) {
    const std::string x = px(frame.at_x(tick));
    out += "<path class=\"grid\" d=\"M" + x + " " + px(top) + "V" + px(height - bottom) + "\"/>\n";
    out += label(frame.at_x(tick), height - bottom + 16, "middle", tick_text(tick));
  }
  std::vector<double> ticks = round_ticks(frame.y.low, frame.y.high, 5);
  if (chart.log_y) std::erase_if(ticks, [](double tick) { return tick != std::floor(tick); });
  for (const double tick : ticks) {
    const std::string y = px(frame.at_y(tick));
    out += "<path class=\"grid\" d=\"M" + px(left) + " " + y + "H" + px(width - right) + "\"/>\n";
    out += label(left - 6, frame.at_y(tick) + 4, "end",
                 chart.log_y ? text(std::pow(10, tick), 3) : tick_text(tick));
  }
  out += label((left + width - right) / 2, height - 8, "middle", escaped(chart.x_label));
  out += "<text transform=\"translate(14 " + px((top + height - bottom) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\">" + escaped(chart.y_label) + "</text>\n";
  return out;
}

std::string line_path(const ChartSeries& line, const Frame& frame) {
  std::string path, last;
  bool pen_down = false;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!std::isfinite(line.x[i]) || !frame.is_drawn(line.y[i])) {
      pen_down = false;
      continue;
    }
    const std::string point =
        px(frame.at_x(line.x[i])) + " " + px(frame.at_y(frame.scaled(line.y[i])));
    if (pen_down && point == last) continue;
    path += (pen_down ? "L" : "M") + point;
    last = point;
    pen_down = true;
  }
  return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + line.colour + "\" stroke-width=\"" +
         text(line.width) + "\"/>\n";
}

std::string legend(const Chart& chart) {
  std::string out;
  double x = left;
  for (const ChartSeries& line : chart.series) {
    if (line.name.empty()) continue;
    out += "<path d=\"M" + px(x) + " 25h16\" stroke=\"" + line.colour +
           "\" stroke-width=\"3\"/>\n" + label(x + 21, 29, "start", escaped(line.name));
    x += 36 + 6.3 * static_cast<double>(line.name.size());
  }
  return out;
}

}  // namespace

std::vector<double> round_ticks(double low, double high, int n) {
  const double rough = (high - low) / n;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * (1 - 1e-9)) step = factor * power;
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ticks.push_back(k == 0 ? 0 : k * step);
  return ticks;
}

std::string chart_svg(const Chart& chart) {
  const Frame frame = frame_of(chart);
  std::string out = "<svg class=\"chart\" viewBox=\"0 0 640 300\" role=\"img\" aria-label=\"" +
                    escaped(chart.title) + "\">\n<text class=\"title\" x=\"" + px(left) +
                    "\" y=\"14\">" + escaped(chart.title) + "</text>\n";
  out += axes(chart, frame) + legend(chart);
  for (const ChartSeries& line : chart.series) out += line_path(line, frame);
  return out + "</svg>\n";
}

}  // namespace talus
