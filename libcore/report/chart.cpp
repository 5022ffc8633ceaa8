#include "report/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace talus {
namespace {

constexpr double width = 640, height = 300, left = 66, right = 14, bottom = 44;
constexpr double legend_top = 25, legend_line = 13;  // of its first line, and from line to line

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
  double top = 0;  ///< of the axes, below the legend [px]
  bool log_x = false, log_y = false;

  [[nodiscard]] bool is_drawn(double value_x, double value_y) const {
    return std::isfinite(value_x) && std::isfinite(value_y) && (!log_x || value_x > 0) &&
           (!log_y || value_y > 0);
  }
  [[nodiscard]] double scaled_x(double value) const { return log_x ? std::log10(value) : value; }
  [[nodiscard]] double scaled(double value) const { return log_y ? std::log10(value) : value; }
  [[nodiscard]] double at_x(double value) const {
    return left + (value - x.low) / (x.high - x.low) * (width - left - right);
  }
  [[nodiscard]] double at_y(double value) const {
    return height - bottom - (value - y.low) / (y.high - y.low) * (height - top - bottom);
  }
};

// Where an entry of the legend begins.
struct LegendPlace {
  double x = left, y = legend_top;
};

// The place of each line's entry; the last is where another one would stand.
std::vector<LegendPlace> legend_places(const Chart& chart) {
  std::vector<LegendPlace> places = {{}};
  for (const ChartSeries& line : chart.series) {
    LegendPlace& at = places.back();
    const double wide = line.name.empty() ? 0 : 36 + 6.3 * static_cast<double>(line.name.size());
    if (at.x > left && at.x + wide > width) at = {left, at.y + legend_line};
    places.push_back({at.x + wide, at.y});
  }
  return places;
}

Frame frame_of(const Chart& chart) {
  Frame frame;
  frame.top = legend_places(chart).back().y + 9;
  frame.log_x = chart.log_x;
  frame.log_y = chart.log_y;
  for (const ChartSeries& line : chart.series)
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!frame.is_drawn(line.x[i], line.y[i])) continue;
      frame.x.add(frame.scaled_x(line.x[i]));
      frame.y.add(frame.scaled(line.y[i]));
      if (!line.y_high.empty() && frame.is_drawn(line.x[i], line.y_high[i]))
        frame.y.add(frame.scaled(line.y_high[i]));
    }
  if (frame.x.is_empty()) frame.x = {0, 1}, frame.y = {0, 1};
  if (!chart.log_y && frame.y.low > 0 && frame.y.low < 0.5 * frame.y.high) frame.y.low = 0;
  if (frame.x.high <= frame.x.low) frame.x.high = frame.x.low + 1;
  const double least = std::max(1e-12, 1e-9 * std::abs(frame.y.high));
  if (frame.y.high - frame.y.low < least) frame.y.high = frame.y.low + (chart.log_y ? 1 : least);
  if (chart.log_y) frame.y = {std::floor(frame.y.low), std::ceil(frame.y.high)};
  if (chart.log_x) frame.x = {std::floor(frame.x.low), std::ceil(frame.x.high)};
  return frame;
}

std::string label(double x, double y, const char* anchor, const std::string& words) {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\">" + words +
         "</text>\n";
}

// On a logarithmic axis: powers of ten.
std::vector<double> ticks_of(const Range& range, int n, bool is_log) {
  std::vector<double> ticks = round_ticks(range.low, range.high, n);
  if (is_log) std::erase_if(ticks, [](double tick) { return tick != std::floor(tick); });
  return ticks;
}

std::string axes(const Chart& chart, const Frame& frame) {
  const auto words = [](double tick, bool is_log) {
    return is_log ? text(std::pow(10, tick), 3) : tick_text(tick);
  };
  std::string out;
  for (const double tick : ticks_of(frame.x, 6, chart.log_x)) {
    const std::string x = px(frame.at_x(tick));
    out += "<path class=\"grid\" d=\"M" + x + " " + px(frame.top) + "V" + px(height - bottom) +
           "\"/>\n";
    out += label(frame.at_x(tick), height - bottom + 16, "middle", words(tick, chart.log_x));
  }
  for (const double tick : ticks_of(frame.y, 5, chart.log_y)) {
    const std::string y = px(frame.at_y(tick));
    out += "<path class=\"grid\" d=\"M" + px(left) + " " + y + "H" + px(width - right) + "\"/>\n";
    out += label(left - 6, frame.at_y(tick) + 4, "end", words(tick, chart.log_y));
  }
  out += label((left + width - right) / 2, height - 8, "middle", xml_escaped(chart.x_label));
  out += "<text transform=\"translate(14 " + px((frame.top + height - bottom) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\">" + xml_escaped(chart.y_label) + "</text>\n";
  return out;
}

std::string line_path(const ChartSeries& line, const Frame& frame) {
  std::string path, last;
  bool pen_down = false;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!frame.is_drawn(line.x[i], line.y[i])) {
      pen_down = false;
      continue;
    }
    const std::string point =
        px(frame.at_x(frame.scaled_x(line.x[i]))) + " " + px(frame.at_y(frame.scaled(line.y[i])));
    if (pen_down && point == last) continue;
    path += (pen_down ? "L" : "M") + point;
    last = point;
    pen_down = true;
  }
  return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + line.colour + "\" stroke-width=\"" +
         text(line.width) + "\"/>\n";
}

std::string band_path(const ChartSeries& band, const Frame& frame) {
  std::string path;
  const auto add = [&](double x, double y) {
    if (frame.is_drawn(x, y))
      path += (path.empty() ? "M" : "L") + px(frame.at_x(frame.scaled_x(x))) + " " +
              px(frame.at_y(frame.scaled(y)));
  };
  for (std::size_t i = 0; i < band.x.size(); ++i) add(band.x[i], band.y[i]);
  for (std::size_t i = band.x.size(); i-- > 0;) add(band.x[i], band.y_high[i]);
  return "<path d=\"" + path + "Z\" fill=\"" + band.colour + "\" fill-opacity=\"0.22\"/>\n";
}

std::string circles(const ChartSeries& line, const Frame& frame) {
  std::string out;
  for (std::size_t i = 0; i < line.x.size(); ++i)
    if (frame.is_drawn(line.x[i], line.y[i]))
      out += "<circle cx=\"" + px(frame.at_x(frame.scaled_x(line.x[i]))) + "\" cy=\"" +
             px(frame.at_y(frame.scaled(line.y[i]))) + "\" r=\"" + text(line.marker) +
             "\" fill=\"none\" stroke=\"" + line.colour + "\"/>\n";
  return out;
}

std::string legend(const Chart& chart) {
  const std::vector<LegendPlace> places = legend_places(chart);
  std::string out;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& line = chart.series[i];
    if (line.name.empty()) continue;
    const auto [x, y] = places[i];
    out += "<path d=\"M" + px(x) + " " + px(y) + "h16\" stroke=\"" + line.colour + "\"" +
           (line.y_high.empty() ? " stroke-width=\"3\"" : " stroke-width=\"9\" opacity=\"0.22\"") +
           "/>\n" + label(x + 21, y + 4, "start", xml_escaped(line.name));
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
                    xml_escaped(chart.title) + "\">\n<text class=\"title\" x=\"" + px(left) +
                    "\" y=\"14\">" + xml_escaped(chart.title) + "</text>\n";
  out += axes(chart, frame) + legend(chart);
  for (const ChartSeries& line : chart.series) {
    if (!line.y_high.empty()) out += band_path(line, frame);
    if (line.width > 0) out += line_path(line, frame);
    if (line.marker > 0) out += circles(line, frame);
  }
  return out + "</svg>\n";
}

std::string chart_file(const Chart& chart) {
  std::string svg = chart_svg(chart);
  const std::string head = "<svg ",
                    styles =
                        "<style>text{font:11px sans-serif;fill:#222}.title{font-size:13px}"
                        ".grid{stroke:#ddd;fill:none}</style>\n"
                        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  svg.insert(svg.find(">\n") + 2, styles);
  return head + "xmlns=\"http://www.w3.org/2000/svg\" " + svg.substr(head.size());
}

}  // namespace talus
