// The maps of a report by the pen.
#include <cmath>

#include "base/text.hpp"
#include "report/encode.hpp"
#include "report/map_sheet.hpp"

namespace talus {
namespace {

constexpr double letters = 2;  // of those on paper: a page shows the frame half as wide

MapSpot spot_of(const MapSheet& sheet) {
  const MapView& view = sheet.ground.view;
  const Vec2 size = 1000 / view.scale * (view.high - view.low);
  return {{0, 0, size.x(), size.y()}, view, letters, true};
}

double px(double mm) { return mm / pixel_mm; }

std::string labels_of(const CellPicture& picture) {
  std::string out;
  for (const auto& [code, label] : picture.labels)
    out += (out.empty() ? "" : ",") + ("\"" + std::to_string(code)) + "\":" + json_string(label);
  return "{" + out + "}";
}

void draw_notes(Pen& pen, const MapSpot& spot, const Texts& texts, const MapPlaces& places) {
  PenLines rim;
  for (const std::vector<Vec2>& ring : places.source) rim.push_back(on_map(spot, ring));
  if (!rim.empty()) pen.note(texts.of("maps.source_place"), rim, false);
  for (const RecordLine& line : places.lines) {
    std::vector<Vec2> points;
    for (const Vec3& p : line.points) points.push_back(on_map(spot, Vec2(p.head<2>())));
    pen.note(line.standing ? texts.of("maps.fence_place", {{"fence", line.name}})
                           : texts.of("maps.line_place", {{"line", line.name}}),
             {points}, false);
  }
}

}  // namespace

std::string sheet_group(const MapSheet& sheet, const std::string& name,
                        const std::function<void(Pen&, const MapSpot&)>& draw) {
  const MapSpot spot = spot_of(sheet);
  return svg_group({spot.frame.width, spot.frame.height, "", 1, [&](Pen& pen) { draw(pen, spot); }},
                   name);
}

std::string sheet_definitions(const Texts& texts, const MapSheet& sheet) {
  const MapView& view = sheet.ground.view;
  const auto number = [](double value) { return text(std::round(100 * value) / 100); };
  return "<svg class=\"none\" width=\"0\" height=\"0\" aria-hidden=\"true\" id=\"sheet\" "
         "data-west=\"" +
         number(view.low.x() + sheet.origin.x()) + "\" data-north=\"" +
         number(view.high.y() + sheet.origin.y()) + "\" data-metres=\"" +
         text(pixel_mm * view.scale / 1000) + "\"><defs>\n" +
         sheet_group(
             sheet, "id=\"map-ground\"",
             [&](Pen& pen, const MapSpot& spot) { draw_shading(pen, spot, sheet.ground); }) +
         sheet_group(sheet, "id=\"map-places\"",
                     [&](Pen& pen, const MapSpot& spot) {
                       draw_contours(pen, spot, sheet.ground);
                       draw_grid(pen, spot, sheet.origin);
                       draw_places(pen, spot, sheet.places);
                       draw_notes(pen, spot, texts, sheet.places);
                       draw_scale_bar(pen, {4, spot.frame.height - 12}, spot.view, letters);
                       draw_north(pen, {spot.frame.width - 6, 4}, letters);
                     }) +
         "</defs></svg>\n";
}

std::string sheet_svg(const MapSheet& sheet, const std::string& between, const std::string& alt) {
  const PageBox frame = spot_of(sheet).frame;
  return "<div class=\"sheet\"><svg class=\"plan\" viewBox=\"0 0 " + text(px(frame.width), 7) +
         " " + text(px(frame.height), 7) + "\" font-family=\"" + page_font +
         ", sans-serif\" font-size=\"10\" role=\"img\" aria-label=\"" + xml_escaped(alt) +
         "\"><use href=\"#map-ground\"/>\n" + between + "<use href=\"#map-places\"/></svg></div>\n";
}

std::string cells_group(const MapSheet& sheet, const MapCells& cells) {
  return sheet_group(sheet, "class=\"cells\"",
                     [&cells](Pen& pen, const MapSpot& spot) { draw_cells(pen, spot, cells); });
}

std::string cells_svg(const MapSheet& sheet, const CellPicture& picture, const std::string& alt,
                      const std::string& unit) {
  const std::string out = sheet_svg(sheet, cells_group(sheet, picture.cells), alt);
  if (picture.values.empty()) return out;
  const PassageGrid& grid = picture.cells.grid;
  const MapSpot spot = spot_of(sheet);
  const Vec2 at = on_map(spot, grid.corner);
  constexpr std::string_view end = "</div>\n";
  return out.substr(0, out.size() - end.size()) +
         "<script type=\"application/json\">{\"x\":" + text(px(at.x()), 9) +
         ",\"y\":" + text(px(at.y()), 9) +
         ",\"cell\":" + text(px(1000 * grid.cell_size / spot.view.scale), 9) +
         ",\"n_cols\":" + std::to_string(grid.n_cols) +
         ",\"n_rows\":" + std::to_string(grid.n_rows) + ",\"unit\":" + json_string(unit) +
         ",\"labels\":" + labels_of(picture) + ",\"values\":\"" + base64(picture.values) +
         "\"}</script></div>\n";
}

}  // namespace talus
