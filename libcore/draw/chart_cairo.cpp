// Line charts by the pen.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/text.hpp"
#include "draw/chart.hpp"
#include "draw/ticks.hpp"

namespace talus {
namespace {

constexpr double width = 640, left = 66, right = 14, bottom = 44;
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

// Where values lie on the page; a logarithmic axis holds logarithms.
struct Frame {
  Range x, y;
  double top = 0, base = 0;  ///< of the axes, below the legend [px]
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
    return base - (value - y.low) / (y.high - y.low) * (base - top);
  }
  [[nodiscard]] Vec2 at(double value_x, double value_y) const {
    return {at_x(scaled_x(value_x)), at_y(scaled(value_y))};
  }
};

// Where an entry of the legend begins.
struct LegendPlace {
  double x = left, y = legend_top;
};

// The place of each line's entry; the last is that of one more entry.
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

// Logarithms of 1, 2 and 5 times the powers of ten about a range.
std::vector<double> log_steps(const Range& range) {
  std::vector<double> steps;
  for (double decade = std::floor(range.low); decade <= std::ceil(range.high); ++decade)
    for (const double factor : {1.0, 2.0, 5.0}) steps.push_back(decade + std::log10(factor));
  return steps;
}

constexpr double few_decades = 2;  // that 1, 2 and 5 are shown of

// The range that begins and ends at a tick.
Range log_range(const Range& range) {
  if (range.high - range.low > few_decades) return {std::floor(range.low), std::ceil(range.high)};
  Range out{range.low, range.low};
  for (const double step : log_steps(range)) {
    if (step <= range.low + 1e-9) out.low = step;
    if (out.high < range.high - 1e-9) out.high = step;
  }
  return out;
}

Frame frame_of(const Chart& chart) {
  Frame frame;
  frame.top = legend_places(chart).back().y + 9;
  frame.base = chart.height - bottom;
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
  if (!chart.log_y && !chart.is_true_scale && frame.y.low > 0 && frame.y.low < 0.5 * frame.y.high)
    frame.y.low = 0;
  if (frame.x.high <= frame.x.low) frame.x.high = frame.x.low + 1;
  const double least = std::max(1e-12, 1e-9 * std::abs(frame.y.high));
  if (frame.y.high - frame.y.low < least) frame.y.high = frame.y.low + (chart.log_y ? 1 : least);
  if (chart.log_y) frame.y = log_range(frame.y);
  if (chart.log_x) frame.x = log_range(frame.x);
  return frame;
}

constexpr Colour ink = rgb(0x333333);
const Letters small{11, false, 0, ink};

std::vector<double> ticks_of(const Range& range, int n, bool is_log) {
  const bool is_short = is_log && range.high - range.low <= few_decades + 1e-9;
  std::vector<double> ticks = is_short ? log_steps(range) : round_ticks(range.low, range.high, n);
  std::erase_if(ticks, [&](double tick) {
    return is_short ? tick < range.low - 1e-9 || tick > range.high + 1e-9
                    : is_log && tick != std::floor(tick);
  });
  return ticks;
}

void draw_axes(Pen& pen, const Chart& chart, const Frame& frame) {
  const auto words = [](double tick, bool is_log) {
    return is_log ? text(std::pow(10, tick), 3) : tick_text(tick);
  };
  PenLines grid;
  for (const double tick : ticks_of(frame.x, 6, chart.log_x)) {
    const double x = frame.at_x(tick);
    grid.push_back({{x, frame.top}, {x, frame.base}});
    pen.words_about({x, frame.base + 12}, words(tick, chart.log_x), small);
  }
  for (const double tick : ticks_of(frame.y, 5, chart.log_y)) {
    const double y = frame.at_y(tick);
    grid.push_back({{left, y}, {width - right, y}});
    pen.words_about({left - 6, y}, words(tick, chart.log_y), small, Anchor::end);
  }
  pen.lines(grid, {1, rgb(0xe2e5e8)});
  pen.words_about({(left + width - right) / 2, chart.height - 12}, chart.x_label, small);
  pen.words_about({10, (frame.top + frame.base) / 2}, chart.y_label, small, Anchor::middle,
                  std::numbers::pi / 2);
}

// The pieces of a line between its gaps.
PenLines pieces_of(const ChartSeries& line, const Frame& frame) {
  PenLines pieces{{}};
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!frame.is_drawn(line.x[i], line.y[i])) {
      if (!pieces.back().empty()) pieces.emplace_back();
      continue;
    }
    const Vec2 at = frame.at(line.x[i], line.y[i]);
    constexpr double seen = 0.05;
    if (pieces.back().empty() || (at - pieces.back().back()).lpNorm<Eigen::Infinity>() > seen)
      pieces.back().push_back(at);
  }
  return pieces;
}

std::vector<Vec2> band_of(const ChartSeries& band, const Frame& frame) {
  std::vector<Vec2> ring;
  const auto add = [&](double x, double y) {
    if (frame.is_drawn(x, y)) ring.push_back(frame.at(x, y));
  };
  for (std::size_t i = 0; i < band.x.size(); ++i) add(band.x[i], band.y[i]);
  for (std::size_t i = band.x.size(); i-- > 0;) add(band.x[i], band.y_high[i]);
  return ring;
}

void draw_markers(Pen& pen, const ChartSeries& line, const Frame& frame) {
  std::vector<Vec2> middles;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!frame.is_drawn(line.x[i], line.y[i])) continue;
    const Vec2 at = frame.at(line.x[i], line.y[i]), half(line.marker, line.marker);
    middles.push_back(at);
    if (!line.notes.empty())
      pen.note(line.notes[i], {{at - half, {at.x(), at.y() + half.y()}, at + half}}, true);
  }
  pen.circles(middles, line.marker, {1, colour_of(line.colour)});
}

Colour band_colour(const ChartSeries& line) {
  Colour colour = colour_of(line.colour);
  colour[3] = 56;
  return colour;
}

void draw_legend(Pen& pen, const Chart& chart) {
  const std::vector<LegendPlace> places = legend_places(chart);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& line = chart.series[i];
    if (line.name.empty()) continue;
    const auto [x, y] = places[i];
    if (line.width == 0 && line.marker > 0)
      pen.circles({{x + 8, y}}, line.marker, {1, colour_of(line.colour)});
    else if (line.y_high.empty())
      pen.line({{x, y}, {x + 16, y}}, {3, colour_of(line.colour)});
    else
      pen.box({x, y - 4.5, 16, 9}, band_colour(line));
    pen.words_about({x + 21, y}, line.name, small, Anchor::begin);
  }
}

void draw(Pen& pen, const Chart& chart) {
  const Frame frame = frame_of(chart);
  pen.words_about({left, 10}, chart.title, {13, true, 0, ink}, Anchor::begin);
  draw_axes(pen, chart, frame);
  draw_legend(pen, chart);
  for (const ChartSeries& line : chart.series) {
    if (!line.y_high.empty()) pen.area({band_of(line, frame)}, band_colour(line));
    if (line.width > 0) pen.lines(pieces_of(line, frame), {line.width, colour_of(line.colour)});
    if (line.marker > 0) draw_markers(pen, line, frame);
  }
}

}  // namespace

Drawing chart_drawing(const Chart& chart) {
  Chart drawn = chart;
  if (chart.is_true_scale) {
    const Frame frame = frame_of(chart);
    drawn.height =
        frame.top + bottom +
        (frame.y.high - frame.y.low) / (frame.x.high - frame.x.low) * (width - left - right);
  }
  return {width, drawn.height, chart.title, pixel_mm, [drawn](Pen& pen) { draw(pen, drawn); }};
}

}  // namespace talus
