// Classes, colours and legends of the map layers.
#include "post/maps/map_style.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/numbers.hpp"
#include "base/text.hpp"
#include "post/maps/map_layers.hpp"

namespace talus {
namespace {

// "0.0005": text() has an exponent for so small a number.
std::string decimal(double limit) {
  char buffer[32];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, limit, std::chars_format::fixed).ptr;
  return {buffer, end};
}

// From the largest loss (blue) over no change (transparent) to the largest gain (red).
std::vector<StyleClass> change_classes(const std::vector<double>& limits, const std::string& unit) {
  std::vector<StyleClass> classes;
  const double n = std::max(1.0, static_cast<double>(limits.size()) - 1);
  const auto label = [&](const char* word, std::size_t i) {
    if (i + 1 == limits.size()) return word + (" by more than " + decimal(limits[i])) + unit;
    return std::string(word) + " by " + decimal(limits[i]) + " - " + decimal(limits[i + 1]) + unit;
  };
  for (std::size_t i = limits.size(); i-- > 0;) {
    classes.push_back(
        {-limits[i], ramp_colour(Ramp::less, static_cast<double>(i) / n), label("less", i)});
  }
  classes.push_back({limits[0], {255, 255, 255, 0}, "within " + decimal(limits[0]) + unit});
  for (std::size_t i = 0; i < limits.size(); ++i)
    classes.push_back({i + 1 < limits.size() ? limits[i + 1] : infinity,
                       ramp_colour(Ramp::more, static_cast<double>(i) / n), label("more", i)});
  return classes;
}

// The limits; ten, a hundred or a thousand times smaller where no change reaches the first: single
// rocks change little. Less than that is rounding.
std::vector<double> limits_for(const MapBand& band, const std::vector<double>& limits) {
  double largest = 0;
  for (const float value : band.value)
    if (!std::isnan(value)) largest = std::max(largest, std::abs(static_cast<double>(value)));
  for (const double finer : {1.0, 10.0, 100.0, 1000.0}) {
    if (largest < limits[0] / finer) continue;
    std::vector<double> out = limits;
    for (double& limit : out) limit /= finer;
    return out;
  }
  return limits;
}

// In no more than a twentieth of the cells that were touched is there no value.
bool is_nearly_everywhere(const MapBand& band) {
  const auto n_missing =
      std::count_if(band.value.begin(), band.value.end(), [](float v) { return std::isnan(v); });
  return !band.value.empty() && static_cast<double>(n_missing) <= 0.05 * band.value.size();
}

int shown_band(const MapLayer& layer, const std::string& wanted) {
  const auto find = [&layer](const std::string& name) {
    for (std::size_t b = 0; b < layer.bands.size(); ++b)
      if (layer.bands[b].name == name) return static_cast<int>(b);
    return -1;
  };
  if (!wanted.empty()) return std::max(0, find(wanted));
  const int p95 = find(layer.name + "_p95");
  return p95 >= 0 && is_nearly_everywhere(layer.bands[p95])
             ? p95
             : std::max(0, find(layer.name + "_max"));
}

// Statistic of the shown band over the blocks that crossed the cell, and its unit.
std::string legend_words(const MapLayer& layer, const MapBand& band) {
  if (band.name == layer.name + "_p95")
    return "95 % of all blocks over the cell stay below [" + band.unit + "]";
  if (band.name == layer.name + "_max")
    return "Largest value of all blocks over the cell [" + band.unit + "]";
  if (layer.name == "reach") return "Blocks over the cell / all released blocks";
  if (layer.name == "exceedance") return "Blocks over the cell with more / all released blocks";
  if (layer.name == "deposit") return "Mean over the runs; rock that never moved is left out [m]";
  if (layer.name == "arrival") return "Earliest block of all runs [s]";
  if (layer.name == "energy_line") return "Smallest of all blocks over the cell [degrees]";
  return band.name + " [" + band.unit + "]";
}

// The Swiss classes of intensity by kinetic energy.
std::string intensity(const std::string& unit, double upper) {
  if (unit != "kJ") return "";
  return upper <= 30 ? " (low)" : upper <= 300 ? " (medium)" : " (high)";
}

}  // namespace

RasterStyle change_style(const MapLayer& layer, const ChangeWords& words, const std::string& remark,
                         const std::vector<double>& breaks) {
  const MapBand& band = layer.bands[0];
  RasterStyle style{
      1, band.name + " [" + band.unit + "]",
      change_classes(limits_for(band, breaks), band.unit == "1" ? "" : " " + band.unit), remark};
  style.heading = words.heading;
  style.legend = words.legend;
  return style;
}

RasterStyle map_style(const MapLayer& layer, const std::string& remark) {
  const MapLayerKind& kind = kind_of(layer);
  RasterStyle style;
  const int index = shown_band(layer, kind.shown_band);
  const MapBand& band = layer.bands[index];
  style.band = index + 1;
  style.title = band.name + " [" + band.unit + "]";
  style.heading = kind.heading;
  style.legend = legend_words(layer, band);
  style.remark = remark;
  const std::string unit = band.unit == "1" ? "" : " " + band.unit;
  if (kind.zero_is_transparent) style.classes.push_back({0, {255, 255, 255, 0}, "0" + unit});
  std::string lower = kind.zero_is_transparent ? "0" : "";
  const double n = static_cast<double>(kind.breaks.size());
  for (std::size_t i = 0; i < kind.breaks.size(); ++i) {
    const double upper = kind.breaks[i];
    style.classes.push_back({upper, ramp_colour(kind.ramp, static_cast<double>(i) / n),
                             (lower.empty() ? "up to " : lower + " - ") + text(upper, 9) + unit +
                                 intensity(band.unit, upper)});
    lower = text(upper, 9);
  }
  style.classes.push_back({infinity, ramp_colour(kind.ramp, 1),
                           "above " + lower + unit + intensity(band.unit, infinity)});
  return style;
}

}  // namespace talus
