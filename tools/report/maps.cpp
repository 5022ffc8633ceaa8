#include "tools/report/maps.hpp"

#include "base/text.hpp"
#include "report/html.hpp"
#include "report/map_figures.hpp"
#include "report/plan_view.hpp"
#include "tools/report/json.hpp"

namespace talus {

namespace {

// Cases stand side by side. Maps of all of them together come behind, and folded where nobody said
// what a case counts.
std::string all_maps(const ReportData& data) {
  const Texts& texts = data.texts;
  if (data.case_maps.empty()) return map_figures(texts, data.sheet, data.maps);
  std::string out = "<h3>" + texts.of("maps.by_case") + "</h3>\n" +
                    case_figures(texts, data.sheet, data.case_maps, true) +
                    html_fold(texts.of("maps.others_by_case"),
                              case_figures(texts, data.sheet, data.case_maps, false));
  if (value_at(data.runout, {"cases_weighed"}) == Json(true))
    return out + "<h3>" + texts.of("maps.cases_weighed") + "</h3>\n" +
           map_figures(texts, data.sheet, data.maps);
  return out + html_fold(texts.of("maps.cases_pooled"), map_figures(texts, data.sheet, data.maps));
}

}  // namespace

std::string map_section(const ReportData& data) {
  const Texts& texts = data.texts;
  const auto key = [](const char* css_class, const std::string& words) {
    return std::string("<i class=\"") + css_class + "\"></i>" + words;
  };
  std::string out = html_figure(
      plan_view_svg(texts, data.shown, data.sheet),
      "<span class=\"key\">" + key("source", texts.of("maps.source")) +
          key("start", texts.of("maps.start")) + key("way", texts.of("maps.paths")) +
          key("end", texts.of("maps.end")) +
          (data.sheet.places.lines.empty() ? "" : key("fence", texts.of("maps.fence"))) +
          (data.shown.objects.empty() ? "" : key("object", texts.of("maps.object"))) + "</span>. " +
          texts.of(data.shown.reach ? "maps.plan_without_frames" : "maps.plan",
                   {{"run", xml_escaped(data.shown_name)},
                    {"interval", text(data.sheet.ground.contour_interval)}}));
  out += html_paragraph(
      texts.of("maps.counting",
               {{"denominator", word_text(value_at(data.runout, {"tags", "DENOMINATOR"}))}}));
  return html_section("maps", texts.of("maps.title"), out + all_maps(data));
}

}  // namespace talus
