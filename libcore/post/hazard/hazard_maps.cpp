// Layers of a hazard map: rates, intensities, classes and their certainty, cell by cell.
#include "post/hazard/hazard_maps.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/numbers.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

// The limits of a recipe as written in names: "0kJ", "30kJ", "300kJ".
std::vector<std::string> limit_names(const Recipe& recipe) {
  std::vector<std::string> names{break_name(recipe, 0)};
  for (const double limit : recipe.breaks) names.push_back(break_name(recipe, limit));
  return names;
}

std::string above_words(const Recipe& recipe, std::size_t i) {
  return i == 0 ? "any block over the cell"
                : std::string("a block over the cell with more than ") +
                      break_name(recipe, recipe.breaks[i - 1]);
}

MapBand band(std::string name, std::string unit, std::string description, std::size_t n) {
  return {std::move(name), std::move(unit), std::move(description), false,
          std::vector<float>(n, std::nanf(""))};
}

// A band with those of its bounds.
void add_bounded(MapLayer& layer, const std::string& name, const std::string& unit,
                 const std::string& description, const std::string& bounds) {
  const std::size_t n = layer.cell.size();
  layer.bands.push_back(band(name, unit, description, n));
  layer.bands.push_back(band(name + "_lo", unit, "lower bound of " + name + ": " + bounds, n));
  layer.bands.push_back(band(name + "_hi", unit, "upper bound of " + name + ": " + bounds, n));
}

void put(MapLayer& layer, std::size_t first_band, std::size_t cell, const Rate& rate) {
  const std::array<double, 3> values = {rate.value, rate.low, rate.high};
  for (std::size_t k = 0; k < 3; ++k)
    layer.bands[first_band + k].value[cell] = static_cast<float>(values[k]);
}

constexpr const char* rate_bounds =
    "95 % interval of the share of events times the bounds of the frequency";

// Layers without values yet, all of the same cells.
struct EmptyLayers {
  const Recipe& recipe;
  const std::vector<std::uint32_t>& cells;
  std::vector<std::string> limits;  // names
  std::vector<MapLayer> layers{};

  MapLayer& start(const std::string& name) {
    return layers.emplace_back(MapLayer{name, cells, {}});
  }
};

void add_shares(const HazardSources& sources, EmptyLayers& to) {
  MapLayer& exceed = to.start("event_exceed");
  for (const HazardRuns& runs : sources.classes)
    for (std::size_t i = 0; i < to.limits.size(); ++i)
      add_bounded(exceed,
                  (sources.classes.size() > 1 ? runs.kind.name + "_" : std::string()) +
                      "event_exceed_" + to.limits[i],
                  "1",
                  std::string("share of the ") + (runs.kind.of_rocks ? "rocks: " : "runs with ") +
                      above_words(to.recipe, i),
                  "95 % interval");
}

void add_probability(double years, EmptyLayers& to) {
  MapLayer& probability = to.start("probability");
  for (std::size_t i = 0; i < to.limits.size(); ++i)
    add_bounded(probability, "probability_" + to.limits[i], "1",
                "that within " + text(years) + " years the mass fails and there is " +
                    above_words(to.recipe, i),
                "95 % interval of the share of events");
}

void add_rates(EmptyLayers& to) {
  const Recipe& recipe = to.recipe;
  const std::vector<std::string>& limits = to.limits;
  MapLayer& events = to.start("event_frequency");
  for (std::size_t i = 0; i < limits.size(); ++i)
    add_bounded(events, "event_frequency_" + limits[i], "1/a",
                "events a year with " + above_words(recipe, i), rate_bounds);
  MapLayer& passages = to.start("passage_frequency");
  for (std::size_t i = 0; i < limits.size(); ++i)
    passages.bands.push_back(band("passage_frequency_" + limits[i], "1/a",
                                  i == 0 ? "blocks a year over the cell"
                                         : "blocks a year over the cell with more than " +
                                               break_name(recipe, recipe.breaks[i - 1]),
                                  to.cells.size()));
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const std::string name = "return_period_" + limits[i];
    add_bounded(to.start(name), name, "a", "1 / frequency of events with " + above_words(recipe, i),
                "1 / the other bound of the frequency; nodata: not bounded");
    for (MapBand& made : to.layers.back().bands) made.overview = OverviewValue::smallest;
  }
  for (const double period : recipe.return_periods) {
    const std::string years = period_name(period), name = "ke_T" + years;
    add_bounded(to.start(name), name, "kJ",
                "largest kinetic energy with spin that comes at least once in " + years +
                    " years; nodata: nothing comes so often",
                "that at the bound of the frequency; nodata: nothing, or not bounded");
  }
}

void add_classes(EmptyLayers& to) {
  const Recipe& recipe = to.recipe;
  MapLayer& intensity = to.start("intensity");
  intensity.is_codes = true;
  for (const double period : recipe.return_periods)
    intensity.bands.push_back(band("intensity_T" + period_name(period), "1",
                                   "reached at least once in " + period_name(period) +
                                       " years: 0 none, then from 1 the weakest",
                                   to.cells.size()));
  MapLayer& classes = to.start("class");
  classes.is_codes = true;
  classes.bands.push_back(
      band("class", "1", "code of the hazard class by " + recipe.name, to.cells.size()));
  MapLayer& certainty = to.start(certainty_layer);
  certainty.is_codes = true;
  for (const auto& [name, words] :
       {std::pair{"class_certain", "1: the same class at both bounds, 0: not"},
        {"class_lo", "class at the lower bound of the frequencies"},
        {"class_hi", "class at the upper bound of the frequencies"},
        {"matrix_number", "of the cell of the matrix that decides, 0: none"}})
    certainty.bands.push_back(band(name, "1", words, to.cells.size()));
}

std::vector<MapLayer> empty_layers(const HazardSources& sources,
                                   const std::vector<std::uint32_t>& cells) {
  EmptyLayers to{sources.recipe, cells, limit_names(sources.recipe)};
  add_shares(sources, to);
  if (!sources.has_frequencies) return std::move(to.layers);
  if (is_localized(sources))
    add_probability(sources.classes[0].kind.years, to);
  else
    add_rates(to);
  if (!is_of_risk(sources.recipe)) add_classes(to);
  return std::move(to.layers);
}

Rate period_of(const Rate& rate) {
  const auto inverse = [](double r) { return r > 0 ? 1 / r : no_value; };
  return {inverse(rate.value), inverse(rate.high), inverse(rate.low)};
}

// Classes at the rates and at their bounds.
void put_class(const Recipe& recipe, const std::vector<Rate>& rates, std::size_t cell,
               MapLayer& intensity, MapLayer& classes, MapLayer& certainty) {
  std::vector<double> value, low, high;
  bool is_bounded = true;
  for (const Rate& rate : rates) {
    value.push_back(rate.value);
    low.push_back(rate.low);
    high.push_back(rate.high);
    is_bounded = is_bounded && !std::isnan(rate.low + rate.high);
  }
  for (std::size_t t = 0; t < recipe.return_periods.size(); ++t)
    intensity.bands[t].value[cell] =
        static_cast<float>(intensity_at(recipe, value, recipe.return_periods[t]));
  const ClassChoice chosen = class_of(recipe, value);
  const int at_low = is_bounded ? class_of(recipe, low).code : no_class,
            at_high = is_bounded ? class_of(recipe, high).code : no_class;
  const auto put_code = [&](MapBand& band, int code) {
    if (code != no_class) band.value[cell] = static_cast<float>(code);
  };
  put_code(classes.bands[0], chosen.code);
  put_code(certainty.bands[1], at_low);
  put_code(certainty.bands[2], at_high);
  certainty.bands[0].value[cell] =
      is_bounded && at_low == chosen.code && at_high == chosen.code ? 1 : 0;
  certainty.bands[3].value[cell] = static_cast<float>(chosen.number);
}

}  // namespace

bool is_localized(const HazardSources& sources) {
  return !sources.classes.empty() && sources.classes[0].kind.kind == FrequencyKind::of_failure;
}

std::vector<MapLayer> hazard_layers(const HazardSources& sources,
                                    const std::vector<EventRow>& rows) {
  const Recipe& recipe = sources.recipe;
  std::vector<std::uint32_t> cells;
  std::vector<std::size_t> begin;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (cells.empty() || rows[i].cell != cells.back()) {
      cells.push_back(rows[i].cell);
      begin.push_back(i);
    }
  begin.push_back(rows.size());
  std::vector<MapLayer> layers = empty_layers(sources, cells);
  HazardRates at(sources.classes);
  const bool localized = is_localized(sources);
  const std::size_t n_limits = recipe.breaks.size() + 1;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::span<const EventRow> of_cell(rows.data() + begin[c], begin[c + 1] - begin[c]);
    for (std::size_t k = 0; k < sources.classes.size(); ++k) {
      const std::vector<Rate> shares = at.shares_above(of_cell, recipe.breaks, k);
      for (std::size_t i = 0; i < n_limits; ++i)
        put(layers[0], 3 * (k * n_limits + i), c, shares[i]);
    }
    if (!sources.has_frequencies) continue;
    const std::vector<Rate> rates = at.above(of_cell, recipe.breaks);
    std::size_t next = 1;
    if (localized) {
      const double years = sources.classes[0].kind.years;
      const auto chance = [years](double rate) { return -std::expm1(-rate * years); };
      for (std::size_t i = 0; i < n_limits; ++i)
        put(layers[next], 3 * i, c,
            {chance(rates[i].value), chance(rates[i].low), chance(rates[i].high)});
      ++next;
    } else {
      const std::vector<double> passages = at.passages_above(of_cell, recipe.breaks);
      const std::vector<Rate> energies = at.energies(of_cell, recipe.return_periods);
      for (std::size_t i = 0; i < n_limits; ++i) {
        put(layers[next], 3 * i, c, rates[i]);
        layers[next + 1].bands[i].value[c] = static_cast<float>(passages[i]);
        put(layers[next + 2 + i], 0, c, period_of(rates[i]));
      }
      next += 2 + n_limits;
      for (const Rate& energy : energies) put(layers[next++], 0, c, energy);
    }
    if (!is_of_risk(recipe))
      put_class(recipe, rates, c, layers[next], layers[next + 1], layers[next + 2]);
  }
  return layers;
}

namespace {

Colour opaque(const std::array<std::uint8_t, 3>& rgb) { return {rgb[0], rgb[1], rgb[2], 255}; }

std::vector<StyleClass> class_colours(const Recipe& recipe) {
  std::vector<StyleClass> classes;
  for (const RecipeClass& c : recipe.classes) {
    classes.push_back({static_cast<double>(c.code), opaque(c.rgb), c.label});
    classes.back().is_hatched = c.is_hatched;
  }
  return classes;
}

std::vector<StyleClass> intensity_colours(const Recipe& recipe) {
  std::vector<StyleClass> classes{{0, {255, 255, 255, 0}, "none"}};
  const auto n = static_cast<double>(recipe.intensities.size());
  for (std::size_t i = 0; i < recipe.intensities.size(); ++i)
    classes.push_back({static_cast<double>(i) + 1,
                       ramp_colour(Ramp::intensity, (static_cast<double>(i) + 1) / n),
                       intensity_words(recipe, i)});
  return classes;
}

std::string capital(std::string words) {
  if (!words.empty())
    words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words;
}

// Of a legend; a recipe of risk does not have its own periods.
std::vector<double> longer_than(const std::vector<double>& periods) {
  std::vector<double> all = periods.empty() ? std::vector<double>{30, 100, 300} : periods;
  const double last = all.back();
  for (const double factor : {3.0, 10.0}) all.push_back(last * factor);
  return all;
}

}  // namespace

std::vector<StyleClass> stepped_classes(const std::vector<double>& limits, const std::string& unit,
                                        bool is_deep_low, Ramp ramp) {
  std::vector<StyleClass> classes;
  const auto n = static_cast<double>(limits.size());
  const auto colour = [&](std::size_t i) {
    const double share = static_cast<double>(i) / n;
    return ramp_colour(ramp, is_deep_low ? 1 - share : share);
  };
  std::string lower;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const std::string upper = text(limits[i], 4);
    classes.push_back(
        {limits[i], colour(i), (lower.empty() ? "up to " : lower + " - ") + upper + unit});
    lower = upper;
  }
  classes.push_back({infinity, colour(limits.size()), "above " + lower + unit});
  return classes;
}

VectorStyle class_style(const Recipe& recipe, double outline_mm, const std::string& label) {
  VectorStyle style{SymbolKind::polygon, "code", {}, outline_mm, label};
  for (auto c = recipe.classes.rbegin(); c != recipe.classes.rend(); ++c)
    style.classes.push_back({std::to_string(c->code),
                             c->label,
                             {c->rgb[0], c->rgb[1], c->rgb[2], 180},
                             c->is_hatched ? "b_diagonal" : "solid"});
  return style;
}

RasterStyle hazard_style(const MapLayer& layer, const Recipe& recipe, const std::string& remark,
                         const std::vector<std::string>& notes) {
  RasterStyle style;
  style.remark = remark;
  style.notes = notes;
  const MapBand* shown = &layer.bands[0];
  if (layer.name == "class") {
    style.classes = class_colours(recipe);
    style.title = "hazard class";
    style.heading = "Hazard classes";
    style.legend = "Class by " + recipe.name;
    return style;
  }
  if (layer.name == certainty_layer) {
    style.classes = {{0, {40, 40, 40, 255}, "not certain"}, {1, {190, 190, 190, 255}, "certain"}};
    style.title = "class certain";
    style.heading = "Certainty of the hazard classes";
    style.legend = "The same class at both bounds of the frequencies";
    return style;
  }
  if (layer.name == "intensity") {
    style.band = static_cast<int>(layer.bands.size());
    shown = &layer.bands.back();
    style.classes = intensity_colours(recipe);
    style.title = shown->name;
    style.heading = "Intensity within " + period_name(recipe.return_periods.back()) + " years";
    style.legend = "Reached at least once in that time";
    return style;
  }
  if (layer.name.starts_with("return_period")) {
    style.classes =
        stepped_classes(longer_than(recipe.return_periods), " a", true, Ramp::frequency);
    style.heading =
        "Return period of " + shown->description.substr(sizeof("1 / frequency of ") - 1);
    style.legend = "Years between two events [a]";
  } else if (layer.name.starts_with("ke_T")) {
    style.classes = stepped_classes(energy_limits, " kJ", false, Ramp::energy);
    style.heading = "Kinetic energy within " + layer.name.substr(4) + " years";
    style.legend = "Largest, with rotation, that comes at least once in that time [kJ]";
  } else if (layer.name == "event_exceed" || layer.name == "probability") {
    style.classes =
        stepped_classes({0.001, 0.01, 0.05, 0.1, 0.2, 0.5, 0.9}, "", false, Ramp::probability);
    const bool is_share = layer.name == "event_exceed";
    style.heading = is_share ? "Probability of reach in an event" : "Probability of reach";
    style.legend = capital(shown->description);
  } else {
    std::vector<double> rates;
    for (const double period : longer_than(recipe.return_periods))
      rates.insert(rates.begin(), 1 / period);
    style.classes = stepped_classes(rates, " a year", false, Ramp::frequency);
    style.heading = layer.name == "event_frequency" ? "Frequency of events" : "Frequency of blocks";
    style.legend = capital(shown->description) + " [1/a]";
  }
  style.title = shown->name + " [" + shown->unit + "]";
  return style;
}

std::vector<int> smoothed_classes(std::vector<int> codes, int n_rows, int n_cols, int times) {
  const auto at = [n_cols](int row, int col) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(n_cols) +
           static_cast<std::size_t>(col);
  };
  for (int k = 0; k < times; ++k) {
    const std::vector<int> from = codes;
    for (int row = 0; row < n_rows; ++row)
      for (int col = 0; col < n_cols; ++col) {
        std::array<int, 256> count{};
        for (int r = std::max(0, row - 1); r <= std::min(n_rows - 1, row + 1); ++r)
          for (int c = std::max(0, col - 1); c <= std::min(n_cols - 1, col + 1); ++c)
            ++count[static_cast<std::size_t>(from[at(r, c)])];
        int most = no_class;
        for (int code = 0; code < no_class; ++code)  // the worse of two, above none
          if (count[static_cast<std::size_t>(code)] > 0 &&
              count[static_cast<std::size_t>(code)] >= count[static_cast<std::size_t>(most)])
            most = code;
        codes[at(row, col)] = most;
      }
  }
  return codes;
}

}  // namespace talus
