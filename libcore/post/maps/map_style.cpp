#include "post/maps/map_style.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "post/maps/map_layers.hpp"

namespace talus {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// From the largest loss (blue) over no change (transparent) to the largest gain (red).
std::vector<StyleClass> change_classes(const std::vector<double>& limits, const std::string& unit) {
  std::vector<StyleClass> classes;
  const auto n = static_cast<double>(limits.size());
  const auto label = [&](const char* word, std::size_t i) {
    if (i + 1 == limits.size()) return word + (" by more than " + text(limits[i])) + unit;
    return std::string(word) + " by " + text(limits[i]) + " - " + text(limits[i + 1]) + unit;
  };
  for (std::size_t i = limits.size(); i-- > 0;) {
    const double share = (static_cast<double>(i) + 1) / n;
    const auto part = [share](double pale, double deep) {
      return static_cast<std::uint8_t>(std::lround(pale + share * (deep - pale)));
    };
    classes.push_back(
        {-limits[i], {part(222, 8), part(235, 48), part(247, 107), 255}, label("less", i)});
  }
  classes.push_back({limits[0], {255, 255, 255, 0}, "within " + text(limits[0]) + unit});
  for (std::size_t i = 0; i < limits.size(); ++i)
    classes.push_back({i + 1 < limits.size() ? limits[i + 1] : infinity,
                       map_ramp((static_cast<double>(i) + 1) / n), label("more", i)});
  return classes;
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

// The Swiss classes of intensity by kinetic energy.
std::string intensity(const std::string& unit, double upper) {
  if (unit != "kJ") return "";
  return upper <= 30 ? " (low)" : upper <= 300 ? " (medium)" : " (high)";
}

}  // namespace

Colour map_ramp(double share) {
  constexpr std::array<std::array<double, 3>, 6> stops = {{{255, 249, 196},
                                                           {254, 217, 118},
                                                           {253, 141, 60},
                                                           {227, 26, 28},
                                                           {158, 1, 66},
                                                           {73, 0, 106}}};
  const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(place), stops.size() - 2);
  const double s = place - static_cast<double>(i);
  Colour colour{0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] =
        static_cast<std::uint8_t>(std::lround(stops[i][k] + s * (stops[i + 1][k] - stops[i][k])));
  return colour;
}

RasterStyle change_style(const MapLayer& layer, const std::string& remark,
                         const std::vector<double>& breaks) {
  const MapBand& band = layer.bands[0];
  return {1, band.name + " [" + band.unit + "]",
          change_classes(breaks, band.unit == "1" ? "" : " " + band.unit), remark};
}

RasterStyle map_style(const MapLayer& layer, const std::string& remark) {
  const MapLayerKind& kind = kind_of(layer);
  RasterStyle style;
  const int index = shown_band(layer, kind.shown_band);
  const MapBand& band = layer.bands[index];
  style.band = index + 1;
  style.title = band.name + " [" + band.unit + "]";
  style.remark = remark;
  const std::string unit = band.unit == "1" ? "" : " " + band.unit;
  if (kind.zero_is_transparent) style.classes.push_back({0, {255, 255, 255, 0}, "0" + unit});
  std::string lower = kind.zero_is_transparent ? "0" : "";
  const double n = static_cast<double>(kind.breaks.size());
  for (std::size_t i = 0; i < kind.breaks.size(); ++i) {
    const double upper = kind.breaks[i];
    style.classes.push_back({upper, map_ramp(static_cast<double>(i) / n),
                             (lower.empty() ? "up to " : lower + " - ") + text(upper, 9) + unit +
                                 intensity(band.unit, upper)});
    lower = text(upper, 9);
  }
  style.classes.push_back(
      {infinity, map_ramp(1), "above " + lower + unit + intensity(band.unit, infinity)});
  return style;
}

}  // namespace talus
