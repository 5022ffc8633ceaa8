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
  if (data.case_maps.empty()) return map_figures(data.sheet, data.maps);
  std::string out =
      "<h3>Maps case by case</h3>\n" + case_figures(data.sheet, data.case_maps, true) +
      html_fold("Other maps case by case", case_figures(data.sheet, data.case_maps, false));
  if (value_at(data.runout, {"cases_weighed"}) == Json(true))
    return out + "<h3>All cases together, by their weights</h3>\n" +
           map_figures(data.sheet, data.maps);
  return out + html_fold("All cases pooled, each run alike: no probability",
                         map_figures(data.sheet, data.maps));
}

}  // namespace

std::string map_section(const ReportData& data) {
  std::string out = html_figure(
      plan_view_svg(data.shown, data.sheet),
      "<span class=\"key\"><i class=\"source\"></i>source<i class=\"start\"></i>start<i "
      "class=\"way\"></i>paths of the "
      "centroids<i class=\"end\"></i>end" +
          std::string(data.sheet.lines.empty() ? "" : "<i class=\"fence\"></i>fence line") +
          (data.shown.objects.empty() ? "" : "<i class=\"object\"></i>object") + "</span>. Run " +
          xml_escaped(data.shown_name) +
          (data.shown.reach ? ", which has no frames between start and end" : "") +
          "; heights every " + text(data.sheet.ground.contour_interval) + " m; north is up.");
  out += html_paragraph(
      "Every cell counts a block once, with its largest value over all steps of the solver. A "
      "share is that of the number of blocks, whatever their size, times the statistical weight of "
      "their run: " +
      word_text(value_at(data.runout, {"tags", "DENOMINATOR"})) +
      ". With few passages the maps show largest values, else the 95th percentile: the legend "
      "says which. <code>NAME.pdf</code> beside each map is its page, to be printed.");
  return html_section("maps", "Maps", out + all_maps(data));
}

}  // namespace talus
