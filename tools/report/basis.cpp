#include "tools/report/basis.hpp"

#include "base/text.hpp"
#include "report/html.hpp"
#include "report/provenance.hpp"
#include "site/soils.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

std::string plan_table(const ReportData& data) {
  const Json plan = Json::parse(data.shown.info.plan, nullptr, false);
  std::vector<std::vector<std::string>> rows;
  if (plan.is_array())
    for (const Json& item : plan)
      rows.push_back({word_text(value_at(item, {"item"})),
                      number_text(value_at(item, {"on"})) == "yes" ? "computed" : "left out",
                      word_text(value_at(item, {"reason"})), word_text(value_at(item, {"rule"}))});
  return html_table({"item", "", "because", "rule"}, rows);
}

std::string settings_table(const Site& site, bool defaults) {
  std::vector<std::vector<std::string>> rows;
  for (const EffectiveValue& value : effective_values(site)) {
    if (value.value.empty() || (value.source == "default") != defaults) continue;
    rows.push_back({"<code>" + xml_escaped(value.section + "." + value.key) + "</code>",
                    "<code>" + xml_escaped(value.value) + "</code>"});
  }
  return html_table({"key", "value"}, rows);
}

// The plane that a daylighting failure surface was found to be; empty for other surfaces.
std::string failure_plane(const ReportData& data) {
  const Json planes = value_at(data.blocks, {"cut", "failure_planes"});
  for (const Json& plane : value_at(planes, {"sets"}))
    if (value_at(plane, {"set"}) == value_at(planes, {"taken"}))
      return "plane of joint set " + word_text(value_at(plane, {"set"})) + ": dip " +
             number_text(value_at(plane, {"dip_deg"}), 3) + " degrees towards " +
             number_text(value_at(plane, {"dip_direction_deg"}), 3) + ", " +
             number_text(value_at(plane, {"above_friction_deg"}), 2) +
             " degrees steeper than friction; comes out of the ground along " +
             percent_text(value_at(plane, {"free_share_of_foot"})) +
             " of the foot, steps before the rest up to " +
             number_text(value_at(plane, {"largest_step_at_foot_m"}), 2) + " m";
  return "";
}

// What the bodies of a section look like.
std::string shape_of(const PlacedSettings& placed) {
  if (placed.shape.empty()) return "meshes of " + placed.file;
  std::string size;
  for (const double edge : placed.size_m) size += (size.empty() ? ", " : " x ") + text(edge, 3);
  if (!size.empty()) size += " m";
  if (placed.shape == "rock")
    return "rocks of " + std::to_string(placed.n_points) + " points" + size;
  if (placed.shape == "prism")
    return "prisms of " + std::to_string(placed.n_sides) + " sides" + size;
  return placed.shape + size;
}

std::string sureness(const ReportData& data) {
  const std::size_t n = data.runs.size();
  std::vector<std::vector<std::string>> rows;
  std::string runs =
      std::to_string(n) + (n < 10 ? ": fewer than 10 give no interval for shares and "
                                    "percentiles of a mass that moves together"
                                  : ": intervals come from the variance between runs; "
                                    "they hold no error of the model");
  if (n >= 10 && !data.runs_to_add.empty())
    runs += ". Runs to add: " + xml_escaped(data.runs_to_add);
  rows.push_back({"Runs", runs});
  if (const Json rmse = value_at(data.trn, {"reference", "rmse_m"}); rmse.is_number())
    rows.push_back(
        {"Terrain", "RMSE " + number_text(rmse, 3) + " m against " +
                        word_text(value_at(data.trn, {"reference", "file"})) + ", largest " +
                        number_text(value_at(data.trn, {"reference", "largest_m"}), 3) + " m"});
  else
    rows.push_back({"Terrain", "not compared with a better one (TRN_FLAGS = --reference DEM)"});
  rows.push_back({"Ground", number_text(value_at(data.trn, {"grid", "cell_size_m"})) +
                                " m cells: what is smaller, the run does not see"});
  for (const GroundSettings& ground : data.site.grounds)
    if (const Soil* soil = soil_named(ground.soil))
      rows.push_back({"Soil", "<code>ground." + xml_escaped(ground.name) + "</code> is " +
                                  xml_escaped(soil->name) + ": " + soil->mark + ". " +
                                  xml_escaped(soil->source)});
  for (const PlacedSettings& placed : data.site.blocks)
    rows.push_back({"Shape", "<code>blocks." + xml_escaped(placed.name) +
                                 "</code>: " + xml_escaped(shape_of(placed)) +
                                 ". Rounder shapes run out farther on the same ground"});
  if (const Json flat = value_at(data.tin, {"flat", "share_before"}); flat.is_number())
    rows.push_back({"Contours", "every " +
                                    number_text(value_at(data.tin, {"contours", "interval_m"})) +
                                    " m; flat triangles " + percent_text(flat) + " of the area, " +
                                    percent_text(value_at(data.tin, {"flat", "share_after"})) +
                                    " after mending"});
  if (const std::string plane = failure_plane(data); !plane.empty())
    rows.push_back({"Failure surface", plane});
  if (const Json cut = value_at(data.blocks, {"cut"}); cut.is_object())
    rows.push_back({"Blocks", number_text(value_at(cut, {"n_slivers_merged"})) + " slivers (" +
                                  number_text(value_at(cut, {"slivers_merged_m3"})) +
                                  " m&sup3;) given to a neighbour; block volume " +
                                  number_text(value_at(cut, {"block_volume_m3"})) + " m&sup3; of " +
                                  number_text(value_at(cut, {"prism_volume_m3"})) +
                                  " m&sup3; of mass"});
  return html_table({"", "how sure"}, rows);
}

}  // namespace

std::string assumption_section(const ReportData& data) {
  std::string out = sureness(data);
  out += html_paragraph(
      "Friction, restitution, joints and depth of the source are what the site file "
      "says; no run can tell whether they hold for this slope. Vary them (CASES of "
      "the pipeline) before anything is decided.");
  out += html_fold("Given in the site file", settings_table(data.site, false));
  out += html_fold("Defaults of the program", settings_table(data.site, true));
  if (!data.stereonet_svg.empty() || !data.sizes_svg.empty()) {
    out += "<div class=\"maps\">\n";
    if (!data.stereonet_svg.empty())
      out += html_figure(html_svg(data.stereonet_svg, "stereonet"), "Joint sets.");
    if (!data.sizes_svg.empty())
      out += html_figure(html_svg(data.sizes_svg, "block sizes"), "Sizes of the blocks.");
    out += "</div>\n";
  }
  return html_section("assumed", "What was assumed, and how sure it is", out);
}

std::string plan_section(const ReportData& data) {
  return html_section(
      "plan", "Scene plan",
      html_paragraph("What the scene needs was computed, and nothing else.") + plan_table(data));
}

std::string provenance_section(const ReportData& data) {
  std::string out =
      data.steps.empty()
          ? html_note("The registry holds no record of these results.")
          : html_paragraph(
                "From the first files to the results, each file with the beginning of its "
                "SHA-256. <code>talus-runs trace FILE</code> prints the ancestry of one "
                "file, <code>talus-runs trace FILE --prov</code> as W3C PROV.") +
                html_fold(std::to_string(data.steps.size()) + " steps",
                          provenance_table(data.steps, data.site.file));
  return html_section("provenance", "Provenance", out);
}

}  // namespace talus
