#include "tools/report/maps.hpp"

#include "base/text.hpp"
#include "report/html.hpp"
#include "report/map_figures.hpp"
#include "report/plan_view.hpp"
#include "tools/report/json.hpp"

namespace talus {

std::string map_section(const ReportData& data) {
  std::string out = html_figure(
      plan_view_svg(data.shown, data.terrain, data.hillshade_png),
      "<span class=\"key\"><i class=\"start\"></i>start<i class=\"way\"></i>paths of the "
      "centroids<i class=\"end\"></i>end<i class=\"fence\"></i>fence line</span>. Run " +
          xml_escaped(data.shown_name) +
          (data.shown.reach ? ", which has no frames between start and end" : "") +
          "; north is up.");
  out += html_paragraph(
      "Every cell counts a block once, with its largest value over all steps of the solver. A "
      "share is that of the number of blocks, whatever their size, times the statistical weight of "
      "their run: " +
      word_text(value_at(data.runout, {"tags", "DENOMINATOR"})) +
      ". With few passages the maps show largest values, else the 95th percentile: the heading of "
      "the picture's legend says which (_max or _p95).");
  return html_section("maps", "Maps", out + map_figures(data.maps));
}

}  // namespace talus
