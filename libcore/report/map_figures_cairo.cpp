// The map layers of a report.
#include <algorithm>

#include "base/text.hpp"
#include "post/maps/map_layers.hpp"
#include "report/html.hpp"
#include "report/map_figures.hpp"
#include "report/map_legend.hpp"

namespace talus {
namespace {

std::string layer_figure(const Texts& texts, const MapSheet& sheet, const MapLayerKind& kind,
                         const MapPicture& picture) {
  const std::string title = texts.said(kind.title);
  return map_figure(texts, sheet, picture, title, kind.unit,
                    "<b>" + title + "</b>: " + texts.said(kind.caption) + " [" + kind.unit +
                        "]. <code>maps/" + kind.name + ".tif</code>");
}

// Layers that are read first: where blocks come to, how fast, with which energy, and where they
// stay.
bool is_of_decisions(const std::string& name) {
  return name == "reach" || name == "velocity" || name == "ke_total" || name == "deposit";
}

const MapPicture* picture_of(const std::vector<MapPicture>& pictures, const std::string& name) {
  const auto found = std::find_if(pictures.begin(), pictures.end(),
                                  [&name](const MapPicture& p) { return p.name == name; });
  return found == pictures.end() ? nullptr : &*found;
}

}  // namespace

std::string map_figure(const Texts& texts, const MapSheet& sheet, const MapPicture& picture,
                       const std::string& alt, const std::string& unit,
                       const std::string& caption) {
  return html_figure(cells_svg(sheet, picture.map, alt, unit),
                     caption + html_legend(texts, picture.qml, picture.weak,
                                           !picture.map.cells.uncertain.empty()));
}

std::string case_figures(const Texts& texts, const MapSheet& sheet, const CasePictures& cases,
                         bool of_decisions) {
  std::string out;
  for (const MapLayerKind& kind : map_layers()) {
    if (is_of_decisions(kind.name) != of_decisions) continue;
    const std::string title = texts.said(kind.title);
    std::string row;
    for (const auto& [name, pictures] : cases) {
      const MapPicture* const picture = picture_of(pictures, kind.name);
      if (picture == nullptr) continue;
      const std::string which = texts.of("maps.layer_of_case", {{"layer", title}, {"case", name}});
      row +=
          map_figure(texts, sheet, *picture, which, kind.unit,
                     "<b>" + texts.of("words.case", {{"case", xml_escaped(name)}}) +
                         "</b>. <code>maps/" + xml_escaped(name) + "/" + kind.name + ".tif</code>");
    }
    if (!row.empty())
      out += "<h3>" + title + " [" + kind.unit + "]</h3>\n<p>" + texts.said(kind.caption) +
             ".</p>\n<div class=\"maps\">\n" + row + "</div>\n";
  }
  return out;
}

std::string map_figures(const Texts& texts, const MapSheet& sheet,
                        const std::vector<MapPicture>& pictures) {
  std::string out = "<div class=\"maps\">\n";
  for (const MapLayerKind& kind : map_layers()) {
    const MapPicture* const picture = picture_of(pictures, kind.name);
    if (picture != nullptr) out += layer_figure(texts, sheet, kind, *picture);
  }
  return out + "</div>\n";
}

}  // namespace talus
