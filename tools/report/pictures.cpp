// The pictures of the page: maps, charts, and the data of the 3-D view.
#include "tools/report/pictures.hpp"

#include <algorithm>
#include <array>

#include "base/csv.hpp"
#include "base/text.hpp"
#include "draw/drawing.hpp"
#include "post/maps/map_drawing.hpp"
#include "report/encode.hpp"
#include "report/plan_view.hpp"
#include "report/run_charts.hpp"
#include "report/viewer_scene.hpp"
#include "tools/frame/factor_chart.hpp"
#include "tools/report/page.hpp"

namespace talus {
namespace {

std::string svg_address(const std::string& svg) {
  return svg.empty() ? "" : data_address("image/svg+xml", svg);
}

std::string hazard_caption(const Texts& texts, const std::string& name) {
  if (name == "class") return texts.of("hazard.class_map");
  if (name == "intensity") return texts.of("hazard.intensity_map");
  if (name.starts_with("return_period")) return texts.of("hazard.return_period_map");
  if (name.starts_with("ke_T"))
    return texts.of("hazard.energy_map", {{"years", xml_escaped(name.substr(4))}});
  if (name == "probability") return texts.of("hazard.probability_map");
  if (name == "event_exceed") return texts.of("hazard.exceedance_map");
  return texts.of("hazard.frequency_map");
}

std::string hazard_figure(const Texts& texts, const MapSheet& sheet, const MapPicture& map) {
  const std::string unit = map.name.starts_with("return_period") ? texts.of("hazard.years")
                           : map.name.starts_with("ke_T")        ? "kJ"
                                                                 : "1";
  const std::string caption = hazard_caption(texts, map.name);
  return map_figure(texts, sheet, map, caption.substr(0, caption.find('.')), unit,
                    caption + " <code>hazard/" + xml_escaped(map.name) + ".tif</code>");
}

// Runs without frames lack curves: the file holds its heading alone.
Json curves_of(const ReportData& data) {
  Json charts = Json::array();
  if (data.curves_csv.find('\n') + 1 >= data.curves_csv.size()) return charts;
  const CsvTable table = parse_csv(data.curves_csv, "curves.csv");
  for (const auto& [column, title, unit] :
       {std::array{"max_speed_m_s", "curves.fastest", "m/s"},
        std::array{"mean_speed_m_s", "curves.mean_speed", "m/s"},
        std::array{"front_m", "curves.front", "m"},
        std::array{"translational_energy_kj", "curves.energy", "kJ"}})
    charts.push_back(chart_svg(curve_chart(data.texts, table, column, data.texts.of(title), unit)));
  return charts;
}

// Of a site with water.
std::string stability_chart(const Texts& texts, const Json& stability) {
  const Json water = value_at(stability, {"water"});
  if (!water.is_string()) return "";
  const auto group = [&](std::size_t k) {
    return texts.said(stability.at("groups").at(k).at("group").get<std::string>());
  };
  return chart_svg(factor_chart(
      stability,
      {texts.of("stability.chart"), texts.said(water.get<std::string>()),
       texts.of("stability.factor"), group(0), group(1), texts.of("stability.fails_below")}));
}

}  // namespace

std::string observed_chart(const Texts& texts, const Json& boulders) {
  const auto numbers = [](const Json& list) {
    std::vector<double> out;
    for (const Json& number : list)
      if (number.is_number()) out.push_back(number.get<double>());
    return out;
  };
  std::vector<double> seen;
  for (const Json& point : boulders.at("points"))
    seen.push_back(point.at("runout_m").get<double>());
  std::sort(seen.begin(), seen.end());
  ChartSeries computed{texts.of("observed.chart_computed"),
                       "#1f5fa8",
                       numbers(boulders.at("computed_runout_m")),
                       {}},
      observed{texts.of("observed.chart_observed"), "#c2491d", seen, {}, 0, 3.5};
  const auto share = [](std::size_t i, double shift, std::size_t n) {
    return 100 * (static_cast<double>(i) + shift) / static_cast<double>(n);
  };
  for (std::size_t i = 0; i < computed.x.size(); ++i)
    computed.y.push_back(share(i, 0, computed.x.size() - 1));
  for (std::size_t i = 0; i < seen.size(); ++i) observed.y.push_back(share(i, 0.5, seen.size()));
  return chart_svg({texts.of("observed.chart"),
                    texts.of("observed.chart_x"),
                    texts.of("observed.chart_y"),
                    {std::move(computed), std::move(observed)}});
}

namespace {

// Bars from a line at 0, as far as -1 and 1 in each direction that there is.
Drawing bars_drawing(const std::vector<Bar>& bars, const std::string& title) {
  constexpr double row = 22, top = 26, label = 250, width = 640, right = 50;
  const double height = top + row * static_cast<double>(bars.size()) + 6;
  const auto draw = [=](Pen& pen) {
    const Letters letters{12};
    double low = 0;
    for (const Bar& bar : bars) low = std::min(low, bar.value);
    low = low < -0.02 ? -1 : 0;
    const double scale = (width - label - right) / (1 - low), zero = label - low * scale;
    pen.words_about({0, 10}, title, letters, Anchor::begin);
    double y = top;
    for (const Bar& bar : bars) {
      const double end = zero + std::clamp(bar.value, low, 1.0) * scale;
      const double from = std::min(zero, end), to = std::max(zero, end);
      pen.words_about({label - 8, y + row / 2}, bar.name, letters, Anchor::end);
      pen.box({from, y + 4, std::max(1.0, to - from), row - 8},
              rgb(bar.value < 0 ? 0xb5533c : 0x2f6f9f));
      pen.words_about({to + 6, y + row / 2}, text(bar.value, 2), letters, Anchor::begin);
      y += row;
    }
    pen.line({{zero, top}, {zero, height - 4}}, {1});
  };
  return {width, height, title, pixel_mm, draw};
}

// Heights of the fences that the lines of a run belong to, 0 for a line without a fence [m].
// Several lines of one fence are named NAME.1, NAME.2 ...
std::vector<double> line_heights(const std::vector<RecordLine>& lines,
                                 const std::vector<FenceSettings>& fences) {
  std::vector<double> heights;
  for (const RecordLine& line : lines) {
    double height = 0;
    for (const FenceSettings& fence : fences)
      if (line.name == fence.name || line.name.starts_with(fence.name + "."))
        height = fence.height_m;
    heights.push_back(height);
  }
  return heights;
}

}  // namespace

Json pictures_of(const ReportData& data) {
  const Texts& texts = data.texts;
  const MapSheet& sheet = data.sheet;
  Json out = {
      {"definitions", sheet_definitions(texts, sheet)},
      {"plan", plan_view_svg(texts, data.shown, sheet)},
      {"maps", map_figures(texts, sheet, data.maps)},
      {"mobility", svg_address(data.mobility_svg)},
      {"stereonet", svg_address(data.stereonet_svg)},
      {"sizes", svg_address(data.sizes_svg)},
      {"stability", stability_chart(texts, data.stability)},
      {"rock", !data.stereonet_svg.empty() || !data.sizes_svg.empty()},
      {"curves", curves_of(data)},
      {"energy", chart_svg(energy_chart(texts, data.shown))},
      {"penetration", chart_svg(health_chart(texts, data.runs, texts.of("health.penetration"), "m",
                                             &HealthRow::largest_penetration))},
      {"time_step", chart_svg(health_chart(texts, data.runs, texts.of("health.time_step"), "s",
                                           &HealthRow::shortest_dt))}};
  if (!data.case_maps.empty()) {
    out["cases"] = case_figures(texts, sheet, data.case_maps, true);
    out["other_cases"] = case_figures(texts, sheet, data.case_maps, false);
  }
  std::string of_class, others, change;
  for (const MapPicture& map : data.hazard_maps)
    (map.name == "class" ? of_class : others) += hazard_figure(texts, sheet, map);
  for (const MapPicture& map : data.change_map)
    change += map_figure(texts, sheet, map, texts.of("fences.change"), "1",
                         texts.of("fences.change_caption"));
  out["hazard_class"] = of_class;
  out["hazard_others"] = others;
  out["change"] = change;
  return out;
}

namespace {

std::string on_map_of_reach(const ReportData& data, const std::string& marks,
                            const std::string& alt) {
  const auto reach = std::find_if(data.maps.begin(), data.maps.end(),
                                  [](const MapPicture& map) { return map.name == "reach"; });
  return sheet_svg(
      data.sheet,
      (reach == data.maps.end() ? "" : cells_group(data.sheet, reach->map.cells)) + marks, alt);
}

}  // namespace

std::string proposal_map(const ReportData& data, const Json& proposals) {
  std::vector<std::pair<std::string, std::vector<Vec2>>> fences;
  for (const Json& proposal : proposals) {
    const Json lines = value_at(proposal, {"lines"});
    if (!lines.is_array()) continue;
    for (const Json& line : lines) {
      fences.emplace_back(value_at(line, {"name"}).get<std::string>(), std::vector<Vec2>{});
      for (const Json& post : line.at("posts"))
        fences.back().second.emplace_back(Vec2(post[0].get<double>(), post[1].get<double>()) -
                                          data.sheet.origin);
    }
  }
  if (fences.empty()) return "";
  const std::string paths =
      sheet_group(data.sheet, "class=\"proposal\"", [&fences](Pen& pen, const MapSpot& spot) {
        for (const auto& [name, posts] : fences) {
          pen.line(on_map(spot, posts), {1.3, rgb(0xc8102e)});
          pen.note(name, {on_map(spot, posts)}, false);
        }
      });
  return on_map_of_reach(data, paths, data.texts.of("search.map"));
}

std::string observed_map(const ReportData& data, const Json& event) {
  const auto local = [&data](const Json& x, const Json& y) {
    return Vec2(Vec2(x.get<double>(), y.get<double>()) - data.sheet.origin);
  };
  const auto places = [&](const char* kind) {
    std::vector<Vec2> out;
    if (const Json points = value_at(event, {kind, "points"}); points.is_array())
      for (const Json& point : points) out.push_back(local(point.at("x_m"), point.at("y_m")));
    return out;
  };
  PenLines outline;
  if (const Json rings = value_at(event, {"outline", "rings_m"}); rings.is_array())
    for (const Json& ring : rings) {
      outline.emplace_back();
      for (const Json& corner : ring) outline.back().push_back(local(corner[0], corner[1]));
    }
  const std::string marks =
      sheet_group(data.sheet, "class=\"observed\"", [&](Pen& pen, const MapSpot& spot) {
        for (const std::vector<Vec2>& ring : outline)
          pen.line(on_map(spot, ring), {0.6, rgb(0x000000), {2, 1.2}, 0.3}, true);
        for (const auto& [kind, colour] : {std::pair{"scars", 0x1b7837}, {"boulders", 0x000000}}) {
          const std::vector<Vec2> at = on_map(spot, places(kind));
          pen.dots(at, 1.3, rgb(0xffffff));
          pen.dots(at, 1, rgb(colour));
        }
      });
  return on_map_of_reach(data, marks, data.texts.of("observed.map"));
}

std::string bar_picture(const std::vector<Bar>& bars, const std::string& title) {
  return bars.empty() ? "" : svg_address(svg_of(bars_drawing(bars, title)));
}

std::string scene_of(const ReportData& data) {
  if (data.shown.frames.time.empty() || data.shown.reach) return "";
  const MapView& view = data.sheet.ground.view;
  return viewer_scene(
      data.shown, data.bed,
      {line_heights(data.shown.lines, data.site.fences), data.trails,
       data.sheet.ground.contour_interval, Vec2(view.low.x(), view.high.y()), &data.texts});
}

}  // namespace talus
