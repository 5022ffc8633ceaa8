#include "tools/report/basis.hpp"

#include "base/text.hpp"
#include "report/html.hpp"
#include "report/provenance.hpp"
#include "site/soils.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

std::string plan_table(const ReportData& data) {
  const Json plan = Json::parse_or_null(data.shown.info.plan);
  const Texts& texts = data.texts;
  std::vector<std::vector<std::string>> rows;
  if (plan.is_array())
    for (const Json& item : plan)
      rows.push_back({word_text(value_at(item, {"item"})),
                      texts.of(number_text(value_at(item, {"on"})) == "yes" ? "plan.computed"
                                                                            : "plan.left_out"),
                      word_text(value_at(item, {"reason"})), word_text(value_at(item, {"rule"}))});
  return html_table(texts.list("plan.heads"), rows);
}

std::string settings_table(const Texts& texts, const Site& site, bool defaults) {
  std::vector<std::vector<std::string>> rows;
  for (const EffectiveValue& value : effective_values(site)) {
    if (value.value.empty() || (value.source == "default") != defaults) continue;
    rows.push_back({"<code>" + xml_escaped(value.section + "." + value.key) + "</code>",
                    "<code>" + xml_escaped(value.value) + "</code>"});
  }
  return html_table(texts.list("assumed.setting_heads"), rows);
}

// The plane that a daylighting failure surface was found to be; empty for other surfaces.
std::string failure_plane(const ReportData& data) {
  const Json planes = value_at(data.blocks, {"cut", "failure_planes"});
  for (const Json& plane : value_at(planes, {"sets"}))
    if (value_at(plane, {"set"}) == value_at(planes, {"taken"}))
      return data.texts.of(
          "assumed.plane",
          {{"set", word_text(value_at(plane, {"set"}))},
           {"dip", number_text(value_at(plane, {"dip_deg"}), 3)},
           {"direction", number_text(value_at(plane, {"dip_direction_deg"}), 3)},
           {"above_friction", number_text(value_at(plane, {"above_friction_deg"}), 2)},
           {"free", percent_text(value_at(plane, {"free_share_of_foot"}))},
           {"step", number_text(value_at(plane, {"largest_step_at_foot_m"}), 2)}});
  return "";
}

// What the bodies of a section look like.
std::string shape_of(const Texts& texts, const BodySettings& placed) {
  if (placed.shape.empty()) return texts.of("assumed.meshes", {{"file", xml_escaped(placed.file)}});
  std::string size;
  for (const double edge : placed.size_m) size += (size.empty() ? ", " : " x ") + text(edge, 3);
  if (!size.empty()) size += " m";
  if (placed.shape == "rock")
    return texts.of("assumed.rocks", {{"n", std::to_string(placed.n_points)}}) + size;
  if (placed.shape == "prism")
    return texts.of("assumed.prisms", {{"n", std::to_string(placed.n_sides)}}) + size;
  return xml_escaped(placed.shape) + size;
}

std::string sureness(const ReportData& data) {
  const Texts& texts = data.texts;
  const std::size_t n = data.runs.size();
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const char* what, const std::string& words) {
    rows.push_back({texts.of(what), words});
  };
  std::string runs =
      texts.of(n < 10 ? "assumed.few_runs" : "assumed.many_runs", {{"n", std::to_string(n)}});
  if (n >= 10 && !data.runs_to_add.empty())
    runs += ". " + texts.of("assumed.runs_to_add", {{"runs", xml_escaped(data.runs_to_add)}});
  add("assumed.runs", runs);
  if (const Json rmse = value_at(data.trn, {"reference", "rmse_m"}); rmse.is_number())
    add("assumed.terrain",
        texts.of("assumed.compared",
                 {{"rmse", number_text(rmse, 3)},
                  {"reference", word_text(value_at(data.trn, {"reference", "file"}))},
                  {"largest", number_text(value_at(data.trn, {"reference", "largest_m"}), 3)}}));
  else
    add("assumed.terrain", texts.of("assumed.not_compared"));
  add("assumed.ground",
      texts.of("assumed.cells",
               {{"size", number_text(value_at(data.trn, {"grid", "cell_size_m"}))}}));
  for (const GroundSettings& ground : data.site.grounds)
    if (const Soil* soil = soil_named(ground.soil))
      add("assumed.soil", texts.of("assumed.soil_of", {{"ground", xml_escaped(ground.name)},
                                                       {"soil", xml_escaped(soil->name)},
                                                       {"mark", soil->mark},
                                                       {"source", xml_escaped(soil->source)}}));
  const auto say_shape = [&](const BodySettings& body) {
    add("assumed.shape", texts.of("assumed.shape_of", {{"blocks", xml_escaped(body.name)},
                                                       {"shape", shape_of(texts, body)}}));
  };
  for (const PlacedSettings& placed : data.site.blocks) say_shape(placed);
  for (const RockfallSettings& rocks : data.site.rockfalls) say_shape(rocks);
  if (const Json flat = value_at(data.tin, {"flat", "share_before"}); flat.is_number())
    add("assumed.contours",
        texts.of("assumed.flat",
                 {{"interval", number_text(value_at(data.tin, {"contours", "interval_m"}))},
                  {"before", percent_text(flat)},
                  {"after", percent_text(value_at(data.tin, {"flat", "share_after"}))}}));
  if (const std::string plane = failure_plane(data); !plane.empty())
    add("assumed.failure_surface", plane);
  if (const Json cut = value_at(data.blocks, {"cut"}); cut.is_object())
    add("assumed.blocks",
        texts.of("assumed.slivers", {{"n", number_text(value_at(cut, {"n_slivers_merged"}))},
                                     {"slivers", number_text(value_at(cut, {"slivers_merged_m3"}))},
                                     {"volume", number_text(value_at(cut, {"block_volume_m3"}))},
                                     {"mass", number_text(value_at(cut, {"prism_volume_m3"}))}}));
  return html_table(texts.list("assumed.heads"), rows);
}

}  // namespace

std::string assumption_section(const ReportData& data) {
  const Texts& texts = data.texts;
  std::string out = sureness(data);
  out += html_paragraph(texts.of("assumed.vary"));
  out += html_fold(texts.of("assumed.given"), settings_table(texts, data.site, false));
  out += html_fold(texts.of("assumed.defaults"), settings_table(texts, data.site, true));
  if (!data.stereonet_svg.empty() || !data.sizes_svg.empty()) {
    out += "<div class=\"maps\">\n";
    if (!data.stereonet_svg.empty())
      out += html_figure(html_svg(data.stereonet_svg, texts.of("assumed.stereonet")),
                         texts.of("assumed.stereonet_caption"));
    if (!data.sizes_svg.empty())
      out += html_figure(html_svg(data.sizes_svg, texts.of("assumed.sizes")),
                         texts.of("assumed.sizes_caption"));
    out += "</div>\n";
  }
  return html_section("assumed", texts.of("assumed.title"), out);
}

std::string plan_section(const ReportData& data) {
  return html_section("plan", data.texts.of("plan.title"),
                      html_paragraph(data.texts.of("plan.what")) + plan_table(data));
}

std::string provenance_section(const ReportData& data) {
  const Texts& texts = data.texts;
  std::string out =
      data.steps.empty()
          ? html_note(texts.of("provenance.no_record"))
          : html_paragraph(texts.of("provenance.what")) +
                html_fold(texts.of("provenance.steps", {{"n", std::to_string(data.steps.size())}}),
                          provenance_table(texts, data.steps, data.site.file));
  return html_section("provenance", texts.of("provenance.title"), out);
}

}  // namespace talus
