#include "report/map_sheet.hpp"

#include <cmath>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "report/encode.hpp"
#include "report/map_marks.hpp"

namespace talus {
namespace {

std::string number(double value) { return text(std::round(value * 100) / 100); }

Vec2 size_of(const MapSheet& sheet) { return sheet.ground.view.high - sheet.ground.view.low; }

std::string path(const std::string& css_class, const std::string& d, const std::string& title) {
  return "<path class=\"" + css_class + "\" d=\"" + d + "\">" +
         (title.empty() ? "" : "<title>" + xml_escaped(title) + "</title>") + "</path>\n";
}

std::string words(const Vec2& at, const std::string& anchor, const std::string& content) {
  return "<text x=\"" + number(at.x()) + "\" y=\"" + number(at.y()) + "\"" +
         (anchor.empty() ? "" : " text-anchor=\"" + anchor + "\"") + ">" + content + "</text>";
}

std::string contours_of(const MapSheet& sheet) {
  std::string thin, thick;
  for (const LevelLine& line : sheet.ground.contours)
    (is_numbered(sheet.ground, line) ? thick : thin) += sheet_path(sheet, line.points, false);
  const Vec2 size = size_of(sheet);
  const double per_mm = sheet.ground.view.scale / 1000;
  std::string out = path("contour", thin, "") + path("contour five", thick, "");
  for (const LevelLabel& label : level_labels(sheet.ground, size / per_mm)) {
    const Vec2 at = per_mm * label.at;
    out += "<text class=\"level\" transform=\"translate(" + number(at.x()) + " " + number(at.y()) +
           ") rotate(" + number(-label.angle / degree) +
           ")\" dy=\".35em\" text-anchor=\"middle\">" + text(label.level) + "</text>";
  }
  return out;
}

// Lines of round coordinates, which stand at the left and the lower side.
std::string grid_of(const MapSheet& sheet) {
  const MapView& view = sheet.ground.view;
  const double spacing = 2 * grid_spacing(view);  // letters are larger than on paper
  const Vec2 low = view.low + sheet.origin, high = view.high + sheet.origin, size = size_of(sheet);
  const double unit = size.x() / 100;
  std::string lines, labels;
  for (double k = std::ceil(low.x() / spacing); k * spacing <= high.x(); ++k) {
    const double x = k * spacing - low.x();
    lines += "M" + number(x) + " 0V" + number(size.y());
    if (x > 12 * unit && x < size.x() - 12 * unit)
      labels += words({x, size.y() - 0.8 * unit}, "middle", grouped_text(k * spacing, 9) + " E");
  }
  for (double k = std::ceil(low.y() / spacing); k * spacing <= high.y(); ++k) {
    const double y = high.y() - k * spacing;
    lines += "M0 " + number(y) + "H" + number(size.x());
    if (y > 4 * unit && y < size.y() - 8 * unit)
      labels += words({0.8 * unit, y - 0.5 * unit}, "", grouped_text(k * spacing, 9) + " N");
  }
  return path("grid", lines, "") + "<g class=\"coordinates\">" + labels + "</g>\n";
}

std::string object_of(const MapSheet& sheet, const RecordObject& object) {
  std::string out;
  for (const ObjectPart& part : object.parts) {
    if (part.is_area || part.points.size() > 1) {
      out += path(part.is_area ? "object" : "object line",
                  sheet_path(sheet, part.points, part.is_area), object.name);
    } else if (!part.points.empty()) {
      const Vec2 at = on_sheet(sheet, part.points[0]);
      out += "<circle class=\"object\" cx=\"" + number(at.x()) + "\" cy=\"" + number(at.y()) +
             "\" r=\"" + number(object.radius) + "\"><title>" + xml_escaped(object.name) +
             "</title></circle>\n";
    }
  }
  return out;
}

std::string places_of(const Texts& texts, const MapSheet& sheet) {
  std::string out, rings;
  for (const std::vector<Vec2>& ring : sheet.source) rings += sheet_path(sheet, ring, true);
  if (!rings.empty()) out += path("source", rings, texts.of("maps.source_place"));
  for (const RecordObject& object : sheet.objects) out += object_of(sheet, object);
  for (const RecordLine& line : sheet.lines) {
    std::vector<Vec2> points;
    for (const Vec3& p : line.points) points.emplace_back(p.head<2>());
    const std::string d = sheet_path(sheet, points, false);
    out += line.standing
               ? path("fence", d, texts.of("maps.fence_place", {{"fence", line.name}}))
               : path("fence line", d, texts.of("maps.line_place", {{"line", line.name}}));
  }
  return out;
}

// Cells that are marked, a rectangle a stretch of a row.
std::string hatch_of(const MapSheet& sheet, const CellPicture& cells,
                     const std::vector<bool>& marked, const std::string& kind) {
  const Vec2 at = on_sheet(sheet, cells.corner);
  std::string d;
  for (int row = 0; row < cells.n_rows && !marked.empty(); ++row) {
    const auto is_marked = [&, first = static_cast<std::size_t>(row) * cells.n_cols](int col) {
      return col < cells.n_cols && marked[first + col];
    };
    for (int col = 0, end = 0; col < cells.n_cols; col = end + 1) {
      for (end = col; is_marked(end);) ++end;
      if (end == col) continue;
      const double size = cells.cell_size, length = (end - col) * size;
      d += "M" + number(at.x() + col * size) + " " + number(at.y() + row * size) + "h" +
           number(length) + "v" + number(size) + "h" + number(-length) + "z";
    }
  }
  return d.empty() ? "" : path(kind, d, "");
}

// Stripes at 45 degrees, `distance` apart.
std::string hatch_pattern(const std::string& name, double distance, bool rises, double width,
                          const std::string& colour) {
  return "<pattern id=\"" + name + "\" patternUnits=\"userSpaceOnUse\" width=\"" +
         number(distance) + "\" height=\"" + number(distance) + "\" patternTransform=\"rotate(" +
         (rises ? "45" : "-45") + ")\"><path d=\"M0 0V" + number(distance) + "\" stroke=\"" +
         colour + "\" stroke-width=\"" + number(width) + "\"/></pattern>\n";
}

std::string labels_of(const CellPicture& cells) {
  std::string out;
  for (const auto& [code, label] : cells.labels)
    out += (out.empty() ? "" : ",") + ("\"" + std::to_string(code)) + "\":" + json_string(label);
  return "{" + out + "}";
}

}  // namespace

std::string sheet_path(const MapSheet& sheet, const std::vector<Vec2>& points, bool is_closed) {
  std::string out;
  for (const Vec2& p : points) {
    const Vec2 at = on_sheet(sheet, p);
    out += (out.empty() ? "M" : "L") + number(at.x()) + " " + number(at.y());
  }
  return out + (is_closed ? "Z" : "");
}

std::string sheet_definitions(const Texts& texts, const MapSheet& sheet) {
  const Shading& shading = sheet.ground.shading;
  const double cell = sheet.ground.shading_cell;
  const Vec2 low = sheet.ground.view.low + sheet.origin,
             high = sheet.ground.view.high + sheet.origin;
  return "<svg class=\"none\" width=\"0\" height=\"0\" aria-hidden=\"true\" id=\"sheet\" "
         "data-west=\"" +
         number(low.x()) + "\" data-north=\"" + number(high.y()) + "\"><defs>\n" +
         hatch_pattern("weak", 0.012 * (high.x() - low.x()), false, 0.012 * (high.x() - low.x()),
                       "#fff") +
         hatch_pattern("unsure", 0.01 * (high.x() - low.x()), true, 0.003 * (high.x() - low.x()),
                       "#1e1e1e") +
         "<g id=\"map-ground\"><image width=\"" + number(shading.n_cols * cell) + "\" height=\"" +
         number(shading.n_rows * cell) + "\" preserveAspectRatio=\"none\" href=\"" +
         data_address("image/png", sheet.shading_png) + "\"/></g>\n<g id=\"map-places\">" +
         contours_of(sheet) + grid_of(sheet) + places_of(texts, sheet) + "</g>\n</defs></svg>\n";
}

std::string sheet_svg(const MapSheet& sheet, const std::string& between, const std::string& alt) {
  const Vec2 size = size_of(sheet);
  return "<div class=\"sheet\"><svg class=\"plan\" viewBox=\"0 0 " + number(size.x()) + " " +
         number(size.y()) + "\" font-size=\"" + number(0.022 * size.x()) +
         "\" role=\"img\" aria-label=\"" + xml_escaped(alt) + "\"><use href=\"#map-ground\"/>\n" +
         between + "<use href=\"#map-places\"/>\n" +
         scale_and_north({0, 0}, {size.x(), 0.93 * size.y()}) + "</svg></div>\n";
}

std::string cells_image(const MapSheet& sheet, const CellPicture& cells) {
  const Vec2 at = on_sheet(sheet, cells.corner);
  const auto attribute = [](const char* name, double value) {
    return std::string(" ") + name + "=\"" + number(value) + "\"";
  };
  return "<image class=\"cells\"" + attribute("x", at.x()) + attribute("y", at.y()) +
         attribute("width", cells.n_cols * cells.cell_size) +
         attribute("height", cells.n_rows * cells.cell_size) +
         " preserveAspectRatio=\"none\" href=\"" + data_address("image/png", cells.png) + "\"/>" +
         hatch_of(sheet, cells, cells.weak, "weak") +
         hatch_of(sheet, cells, cells.unsure, "unsure");
}

std::string cells_svg(const MapSheet& sheet, const CellPicture& cells, const std::string& alt,
                      const std::string& unit) {
  const Vec2 at = on_sheet(sheet, cells.corner);
  const std::string out = sheet_svg(sheet, cells_image(sheet, cells), alt);
  if (cells.values.empty()) return out;
  constexpr std::string_view end = "</div>\n";
  return out.substr(0, out.size() - end.size()) +
         "<script type=\"application/json\">{\"x\":" + text(at.x()) + ",\"y\":" + text(at.y()) +
         ",\"cell\":" + text(cells.cell_size) + ",\"n_cols\":" + std::to_string(cells.n_cols) +
         ",\"n_rows\":" + std::to_string(cells.n_rows) + ",\"unit\":" + json_string(unit) +
         ",\"labels\":" + labels_of(cells) + ",\"values\":\"" + base64(cells.values) +
         "\"}</script></div>\n";
}

}  // namespace talus
