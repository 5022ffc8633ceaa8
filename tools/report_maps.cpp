#include "report_maps.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "report/html.hpp"
#include "report/map_legend.hpp"
#include "report/plan_view.hpp"
#include "report_json.hpp"

namespace talus {
namespace {

struct MapText {
  const char *name, *title, *caption;
};

constexpr MapText map_texts[] = {
    {"velocity", "Speed", "largest speed of a block's centroid while it was over the cell [m/s]"},
    {"ke_total", "Energy", "translation and rotation of one block at the same moment [kJ]"},
    {"ke_translational", "Energy of translation",
     "m v&sup2;/2 of one block, what barrier classes are tested with [kJ]"},
    {"pass_height_top", "Passing height, top",
     "highest corner of a block above the ground: a fence has to be taller [m]"},
    {"pass_height_centroid", "Passing height, centroid",
     "centroid of a block above the ground [m]"},
    {"reach", "Reach", "blocks that crossed the cell over all released blocks [1]"},
    {"exceedance", "Exceedance", "share of blocks above 30 and 300 kJ over the cell [1]"},
    {"deposit", "Deposit", "blocks at rest and their thickness over the cell"},
    {"arrival", "First arrival", "earliest time at which a block came over the cell [s]"},
    {"energy_line", "Energy line",
     "smallest angle from a block's start to the cell along its path [deg]"}};

}  // namespace

std::string map_section(const ReportData& data) {
  std::string out = html_figure(
      plan_view_svg(data.shown, data.terrain, data.hillshade_png),
      "<span class=\"key\"><i class=\"start\"></i>start<i class=\"way\"></i>ways of the "
      "centroids<i class=\"end\"></i>end<i class=\"fence\"></i>fence line</span>. Run " +
          xml_escaped(data.shown_name) + "; north is up.");
  out += html_paragraph(
      "Every cell counts a block once, with its largest value over all steps of the solver. Shares "
      "are parts of a sum over blocks, not over tons: " +
      word_text(value_at(data.runout, {"tags", "DENOMINATOR"})) +
      ". With few passages the maps show largest values, else the 95th percentile: the heading of "
      "the picture's legend says which (_max or _p95).");
  out += "<div class=\"maps\">\n";
  for (const MapText& map : map_texts) {
    const auto found = std::find_if(data.maps.begin(), data.maps.end(),
                                    [&map](const MapPicture& p) { return p.name == map.name; });
    if (found == data.maps.end()) continue;
    out += html_figure(html_png(found->png, map.title),
                       "<b>" + std::string(map.title) + "</b>: " + map.caption + ". <code>maps/" +
                           map.name + ".tif</code>" + html_legend(found->qml));
  }
  return html_section("maps", "Maps", out + "</div>\n");
}

}  // namespace talus
