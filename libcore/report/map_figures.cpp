#include "report/map_figures.hpp"

#include <algorithm>

#include "post/maps/map_layers.hpp"
#include "report/html.hpp"
#include "report/map_legend.hpp"

namespace talus {
namespace {

std::string map_figure(const MapLayerKind& kind, const MapPicture& picture) {
  const std::string title = kind.title;
  return html_figure(html_png(picture.png, title), "<b>" + title + "</b>: " + kind.caption + " [" +
                                                       kind.unit + "]. <code>maps/" + kind.name +
                                                       ".tif</code>" + html_legend(picture.qml));
}

}  // namespace

std::string map_figures(const std::vector<MapPicture>& pictures) {
  std::string out = "<div class=\"maps\">\n";
  for (const MapLayerKind& kind : map_layers()) {
    const auto found = std::find_if(pictures.begin(), pictures.end(),
                                    [&kind](const MapPicture& p) { return p.name == kind.name; });
    if (found != pictures.end()) out += map_figure(kind, *found);
  }
  return out + "</div>\n";
}

}  // namespace talus
