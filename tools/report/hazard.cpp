#include "tools/report/hazard.hpp"

#include <algorithm>
#include <filesystem>

#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

std::string class_table(const Json& classes) {
  std::vector<std::vector<std::string>> rows;
  for (auto row = classes.rbegin(); row != classes.rend(); ++row) {
    const Json area = value_at(*row, {"area_m2"}), certain = value_at(*row, {"certain_area_m2"});
    rows.push_back({word_text(value_at(*row, {"class"})), word_text(value_at(*row, {"label"})),
                    number_text(area), number_text(certain)});
  }
  return html_table({"class", "", "area [m&sup2;]", "of it certain [m&sup2;]"}, rows,
                    {false, false, true, true});
}

std::string notes_of(const Json& hazard) {
  std::string out;
  const Json notes = value_at(hazard, {"notes"});
  if (notes.is_array())
    for (const Json& note : notes) out += html_note(word_text(note));
  return out;
}

std::string caption_of(const std::string& name) {
  if (name == "class")
    return "Hazard class. Hatched in black: a bound of the frequencies or of the share of runs "
           "gives another class.";
  if (name == "intensity") return "Intensity that is reached within the longest return period.";
  if (name.starts_with("return_period"))
    return "How many years lie between two events, on average.";
  if (name.starts_with("ke_T"))
    return "Largest energy that comes at least once in " + name.substr(4) + " years.";
  if (name == "probability") return "Probability within the years of the failure.";
  if (name == "event_exceed") return "Share of the runs that reach the place.";
  return "Events or blocks a year.";
}

std::string unit_of(const std::string& name) {
  if (name.starts_with("return_period")) return "years";
  return name.starts_with("ke_T") ? "kJ" : "1";
}

std::string figure_of(const MapSheet& sheet, const MapPicture& map) {
  return map_figure(sheet, map, map.name, unit_of(map.name),
                    caption_of(map.name) + " <code>hazard/" + map.name + ".tif</code>");
}

}  // namespace

std::vector<std::string> hazard_maps_of(const Json& hazard) {
  std::vector<std::string> names;
  const Json layers = value_at(hazard, {"layers"});
  if (!layers.is_array()) return names;
  for (const Json& layer : layers)
    if (const Json file = value_at(layer, {"file"}); file.is_string())
      names.push_back(std::filesystem::path(file.get<std::string>()).stem().string());
  std::reverse(names.begin(), names.end());  // the class first
  return names;
}

std::string hazard_section(const ReportData& data) {
  if (!data.hazard.is_object()) return "";
  std::string out;
  const Json classes = value_at(data.hazard, {"classes"});
  if (!classes.is_array())
    out += html_paragraph(
        "There are no classes: " + word_text(value_at(data.hazard, {"why_no_classes"})) + ".");
  else
    out += class_table(classes) + notes_of(data.hazard);
  std::string more;
  for (const MapPicture& map : data.hazard_maps)
    (map.name == "class" ? out : more) += figure_of(data.sheet, map);
  if (!more.empty()) out += html_fold("Return periods, energies and frequencies", more);
  return html_section("hazard", "Hazard classes", out);
}

}  // namespace talus
