#include "tools/report/hazard.hpp"

#include <algorithm>
#include <filesystem>

#include "base/text.hpp"
#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

std::string class_table(const Texts& texts, const Json& classes) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& row : classes) {
    const Json area = value_at(row, {"area_m2"}), certain = value_at(row, {"certain_area_m2"});
    rows.push_back({word_text(value_at(row, {"class"})), word_text(value_at(row, {"label"})),
                    number_text(area), number_text(certain)});
  }
  std::reverse(rows.begin(), rows.end());
  return html_table(texts.list("hazard.heads"), rows, {false, false, true, true});
}

std::string notes_of(const Json& hazard) {
  std::string out;
  const Json notes = value_at(hazard, {"notes"});
  if (notes.is_array())
    for (const Json& note : notes) out += html_note(word_text(note));
  return out;
}

std::string caption_of(const Texts& texts, const std::string& name) {
  if (name == "class") return texts.of("hazard.class_map");
  if (name == "intensity") return texts.of("hazard.intensity_map");
  if (name.starts_with("return_period")) return texts.of("hazard.return_period_map");
  if (name.starts_with("ke_T"))
    return texts.of("hazard.energy_map", {{"years", xml_escaped(name.substr(4))}});
  if (name == "probability") return texts.of("hazard.probability_map");
  if (name == "event_exceed") return texts.of("hazard.exceedance_map");
  return texts.of("hazard.frequency_map");
}

std::string unit_of(const Texts& texts, const std::string& name) {
  if (name.starts_with("return_period")) return texts.of("hazard.years");
  return name.starts_with("ke_T") ? "kJ" : "1";
}

std::string figure_of(const Texts& texts, const MapSheet& sheet, const MapPicture& map) {
  return map_figure(
      texts, sheet, map, map.name, unit_of(texts, map.name),
      caption_of(texts, map.name) + " <code>hazard/" + xml_escaped(map.name) + ".tif</code>");
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
  const Texts& texts = data.texts;
  std::string out;
  const Json classes = value_at(data.hazard, {"classes"});
  if (!classes.is_array())
    out += html_paragraph(texts.of(
        "hazard.no_classes", {{"why", word_text(value_at(data.hazard, {"why_no_classes"}))}}));
  else
    out += class_table(texts, classes) + notes_of(data.hazard);
  std::string more;
  for (const MapPicture& map : data.hazard_maps)
    (map.name == "class" ? out : more) += figure_of(texts, data.sheet, map);
  if (!more.empty()) out += html_fold(texts.of("hazard.other_maps"), more);
  return html_section("hazard", texts.of("hazard.title"), out);
}

}  // namespace talus
