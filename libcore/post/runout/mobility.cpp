#include "post/runout/mobility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/units.hpp"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

MobilityKind kind_of(const CsvTable& table, std::size_t row) {
  const std::string& word = table.at(row, "kind");
  if (word == "hl_power") return MobilityKind::hl_power;
  if (word == "length") return MobilityKind::length;
  if (word == "angle") return MobilityKind::angle;
  throw InputError({table.file, table.line[row]},
                   "kind is \"" + word + "\", expected hl_power, length or angle");
}

double needed(const CsvTable& table, std::size_t row, const char* name) {
  const double value = table.number(row, name);
  if (std::isnan(value))
    throw InputError({table.file, table.line[row]}, std::string(name) + " is missing");
  return value;
}

// --- the chart ---------------------------------------------------------------------------------

struct Axis {
  double low, high;  // log10 of the values at the ends
  double pixel_low, pixel_high;
  [[nodiscard]] double at(double log_value) const {
    return pixel_low + (log_value - low) / (high - low) * (pixel_high - pixel_low);
  }
};

std::string number(double value) { return text(std::round(value * 10) / 10); }

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) +
         "\" y2=\"" + number(y2) + "\" " + style + "/>\n";
}

std::string label(double x, double y, const std::string& anchor, const std::string& words) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" +
         words + "</text>\n";
}

std::string grid_lines(const Axis& x, const Axis& y) {
  const std::string thin = "stroke=\"#ddd\"";
  std::string out;
  for (int decade = static_cast<int>(x.low); decade <= x.high; ++decade) {
    out += line(x.at(decade), y.pixel_low, x.at(decade), y.pixel_high, thin);
    out += label(x.at(decade), y.pixel_low + 18, "middle", "1e" + std::to_string(decade));
  }
  for (const double value : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0}) {
    const double at = y.at(std::log10(value));
    out += line(x.pixel_low, at, x.pixel_high, at, thin);
    out += label(x.pixel_low - 6, at + 4, "end", text(value));
  }
  out += label((x.pixel_low + x.pixel_high) / 2, y.pixel_low + 38, "middle", "volume V [m3]");
  out += label(x.pixel_low - 6, y.pixel_high - 10, "end", "H/L");
  return out;
}

// The relations of the chart: one a kind of event, of all paths, read in print.
struct Charted {
  const char* id;
  const char* words;
  const char* colour;
};
constexpr std::array charted = {
    Charted{"corominas_rockfall_all", "rockfalls (Corominas 1996)", "#c8553d"},
    Charted{"corominas_slide_all", "translational slides (Corominas 1996)", "#1b6ca8"},
    Charted{"mitchell_hl", "rock avalanches (Mitchell et al. 2019)", "#3a7d44"}};

// The part of a relation's line inside the axes.
std::string relation_line(const MobilityRelation& r, const Axis& x, const Axis& y,
                          const std::string& stroke) {
  double from = x.low, to = x.high;
  for (const double limit : {y.low, y.high}) {
    const double meets = (limit - r.a) / r.b;
    const bool is_above = limit == y.high;
    // With b < 0 the line lies above y.high to the left of `meets`, below y.low to the right.
    if (r.b < 0 ? is_above : !is_above) from = std::max(from, meets);
    if (r.b < 0 ? !is_above : is_above) to = std::min(to, meets);
  }
  if (!(from < to)) return "";
  return line(x.at(from), y.at(r.a + r.b * from), x.at(to), y.at(r.a + r.b * to), stroke);
}

// Between a relation and its lower 95 % line, inside the axes.
std::string band_below(const MobilityRelation& r, const Axis& x, const Axis& y,
                       const std::string& colour) {
  std::string points;
  const auto add = [&](double log_v, double a) {
    const double log_hl = std::clamp(a + r.b * log_v, y.low, y.high);
    points += (points.empty() ? "" : " ") + number(x.at(log_v)) + "," + number(y.at(log_hl));
  };
  constexpr int n = 36;  // points: a line that leaves the axes bends there
  const double step = (x.high - x.low) / n;
  for (int i = 0; i <= n; ++i) add(x.low + i * step, r.a);
  for (int i = n; i >= 0; --i) add(x.low + i * step, r.a - r.lower);
  return "<polygon points=\"" + points + "\" fill=\"" + colour + "\" fill-opacity=\"0.15\"/>\n";
}

}  // namespace

std::vector<MobilityRelation> mobility_relations(const CsvTable& table) {
  std::vector<MobilityRelation> relations;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    MobilityRelation r;
    r.id = table.at(row, "id");
    r.group = table.at(row, "group");
    r.path = table.at(row, "path");
    r.kind = kind_of(table, row);
    r.a = needed(table, row, "a");
    r.b = r.kind == MobilityKind::angle ? none : needed(table, row, "b");
    r.c = r.kind == MobilityKind::length ? needed(table, row, "c") : none;
    r.d = r.kind == MobilityKind::length ? needed(table, row, "d") : none;
    r.lower = table.number(row, "lower");
    r.n = table.number(row, "n");
    r.sd = table.number(row, "sd");
    r.from_memory = table.at(row, "mark") == "m";
    r.source = table.at(row, "source");
    relations.push_back(std::move(r));
  }
  return relations;
}

MobilityRow compare(const MobilityRelation& r, const MobilityEvent& event) {
  MobilityRow row{none, none, none, none};
  if (!(event.volume > 0 && event.height > 0 && event.length > 0)) return row;
  const double log_v = std::log10(event.volume), log_h = std::log10(event.height);
  const double log_l = std::log10(event.length);
  switch (r.kind) {
    case MobilityKind::hl_power: {
      const double log_hl = r.a + r.b * log_v;
      row.length = std::pow(10, log_h - log_hl);
      row.length_upper = std::pow(10, log_h - log_hl + r.lower);
      row.exceedance = normal_cdf((log_h - log_l - log_hl) / r.sd);
      break;
    }
    case MobilityKind::length: {
      const double mean = r.a + r.b * (log_v - 6) + r.c * log_h + (event.confined ? r.d : 0);
      row.length = std::pow(10, mean);
      row.exceedance = normal_cdf((mean - log_l) / r.sd);
      break;
    }
    case MobilityKind::angle:
      row.length = event.height / std::tan(r.a * degree);
      break;
  }
  row.ratio = event.length / row.length;
  return row;
}

std::string mobility_svg(const std::vector<MobilityRelation>& relations,
                         const std::vector<MobilityEvent>& events) {
  const Axis x{0, 9, 60, 560}, y{std::log10(0.05), std::log10(2.5), 430, 40};
  std::string out =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 580 480\" width=\"580\" "
      "height=\"480\" font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"580\" height=\"480\" fill=\"white\"/>\n";
  out += grid_lines(x, y);
  double at = 340;
  for (const Charted& shown : charted)
    for (const MobilityRelation& r : relations) {
      if (r.id != shown.id) continue;
      const std::string stroke = std::string("stroke=\"") + shown.colour + "\" stroke-width=\"2\"";
      if (r.id == std::string("corominas_slide_all")) out += band_below(r, x, y, shown.colour);
      out += relation_line(r, x, y, stroke) + line(72, at - 4, 96, at - 4, stroke);
      out += label(104, at, "start", shown.words);
      at += 20;
    }
  out += "<rect x=\"72\" y=\"" + number(at - 10) +
         "\" width=\"24\" height=\"12\" fill=\"#1b6ca8\" fill-opacity=\"0.15\"/>\n" +
         label(104, at, "start", "slides down to their lower 95 % line");
  for (const MobilityEvent& event : events) {
    if (!(event.volume > 0 && event.height > 0 && event.length > 0)) continue;
    const double log_v = std::clamp(std::log10(event.volume), x.low, x.high);
    const double log_hl = std::clamp(std::log10(event.height / event.length), y.low, y.high);
    out += "<circle cx=\"" + number(x.at(log_v)) + "\" cy=\"" + number(y.at(log_hl)) +
           "\" r=\"5\" fill=\"black\" fill-opacity=\"0.6\"><title>" + event.name +
           "</title></circle>\n";
  }
  out += "<circle cx=\"84\" cy=\"416\" r=\"5\" fill=\"black\" fill-opacity=\"0.6\"/>\n";
  out += label(104, 420, "start", "this event (a point a run)");
  return out + "</svg>\n";
}

}  // namespace talus
