// The parts of a map, and a page of them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "post/maps/map_column.hpp"
#include "post/maps/map_drawing.hpp"

namespace talus {
namespace {

double mm(const MapSpot& spot, double metres) { return 1000 * metres / spot.view.scale; }

bool is_inside(const PageBox& frame, const Vec2& p) {
  return p.x() > frame.x && p.x() < frame.x + frame.width && p.y() > frame.y &&
         p.y() < frame.y + frame.height;
}

std::uint32_t pixel_of(const Colour& colour, double opacity) {
  return static_cast<std::uint32_t>(std::lround(opacity * colour[3])) << 24 |
         static_cast<std::uint32_t>(colour[0]) << 16 | static_cast<std::uint32_t>(colour[1]) << 8 |
         colour[2];
}

// Rows and columns of the cells in the frame.
struct Window {
  int row_begin, row_end, col_begin, col_end;
};

Window window_of(const MapView& view, const PassageGrid& grid) {
  const Vec2 low = (view.low - grid.corner) / grid.cell_size,
             high = (view.high - grid.corner) / grid.cell_size;
  const auto limited = [](double value, int n) {
    return static_cast<int>(std::clamp(value, 0.0, 1.0 * n));
  };
  return {limited(std::floor(-high.y()), grid.n_rows), limited(std::ceil(-low.y()), grid.n_rows),
          limited(std::floor(low.x()), grid.n_cols), limited(std::ceil(high.x()), grid.n_cols)};
}

PageBox box_of(const MapSpot& spot, const PassageGrid& grid, int row, int col, int n_rows,
               int n_cols) {
  const Vec2 corner = on_map(spot, Vec2(grid.corner + grid.cell_size * Vec2(col, -row)));
  return {corner.x(), corner.y(), n_cols * mm(spot, grid.cell_size),
          n_rows * mm(spot, grid.cell_size)};
}

// Boxes of the cells in the frame that `is_marked(cell)`, one a stretch of a row.
template <class Marked>
std::vector<PageBox> stretches(const MapSpot& spot, const PassageGrid& grid, Marked is_marked) {
  const Window w = window_of(spot.view, grid);
  std::vector<PageBox> boxes;
  for (int row = w.row_begin; row < w.row_end; ++row)
    for (int col = w.col_begin, end = 0; col < w.col_end; col = end + 1) {
      for (end = col;
           end < w.col_end && is_marked(static_cast<std::size_t>(row) * grid.n_cols + end);)
        ++end;
      if (end > col) boxes.push_back(box_of(spot, grid, row, col, 1, end - col));
    }
  return boxes;
}

void draw_object(Pen& pen, const MapSpot& spot, const RecordObject& object) {
  const Stroke stroke = object_stroke();
  Vec2 last = Vec2::Constant(-1);
  for (const ObjectPart& part : object.parts) {
    if (part.points.empty()) continue;
    const std::vector<Vec2> points = on_map(spot, part.points);
    if (part.is_area || points.size() > 1) {
      pen.line(points, stroke, part.is_area);
      pen.note(object.name, {points}, part.is_area);
    } else {
      const double radius = std::max(1.0, mm(spot, object.radius));
      pen.circles(points, radius, stroke);
      pen.note(object.name, {{points[0], points[0] + Vec2(radius, 0)}}, false);
    }
    last = *std::max_element(points.begin(), points.end(),
                             [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  }
  draw_name(pen, spot, last, object.name, stroke.colour);
}

// As large as fits into a width.
void fitted_words(Pen& pen, const Vec2& at, double width, const std::string& words,
                  Letters letters) {
  letters.size *= std::min(1.0, width / pen.size_of(words, letters).x());
  pen.words(at, words, letters);
}

ColumnHeights measured(const PageLayout& layout, const MapPage& page, const MapGround& ground,
                       const MapPlaces& places) {
  ColumnHeights heights;
  measure([&](Pen& pen) {
    heights = draw_column(pen, layout.column, layout.column.y, page, ground, places);
  });
  return heights;
}

void draw_map(Pen& pen, const MapSpot& spot, const MapPage& page, const MapGround& ground,
              const MapPlaces& places) {
  pen.clip(spot.frame);
  draw_shading(pen, spot, ground);
  draw_cells(pen, spot, page.cells);
  draw_contours(pen, spot, ground);
  draw_places(pen, spot, places);
  pen.unclip();
  draw_grid(pen, spot, page.origin);
  pen.frame(spot.frame, {0.35});
}

void draw_page(Pen& pen, const MapPage& page, const MapGround& ground, const MapPlaces& places) {
  const PageLayout layout = layout_of(page.size);
  const double left = layout.map.x, width = layout.width - 2 * 8;
  if (!page.cells.style.remark.empty()) {  // that nobody may miss
    pen.box({0, 0, layout.width, 7}, {179, 32, 31, 255});
    fitted_words(pen, {8, 1.6}, width, page.cells.style.remark,
                 {3.2, true, 0, {255, 255, 255, 255}});
  }
  fitted_words(pen, {left, 8}, layout.width - left - 8, page.title, {5, true});
  fitted_words(pen, {left, 15}, layout.width - left - 8, page.subtitle,
               {2.9, false, 0, {70, 70, 70, 255}});
  draw_map(pen, {layout.map, ground.view}, page, ground, places);

  // The whole column smaller where it is too long.
  const ColumnHeights heights = measured(layout, page, ground, places);
  constexpr double gap = 3;
  const double factor = std::min(1.0, layout.column.height / (heights.legend + gap + heights.foot));
  PageBox column = layout.column;
  column.width /= factor;
  column.height /= factor;
  pen.shrink({column.x, column.y}, factor);
  draw_column(pen, column, column.y + column.height - heights.foot, page, ground, places);
}

}  // namespace

Vec2 on_map(const MapSpot& spot, const Vec2& local) {
  return {spot.frame.x + mm(spot, local.x() - spot.view.low.x()),
          spot.frame.y + mm(spot, spot.view.high.y() - local.y())};
}

std::vector<Vec2> on_map(const MapSpot& spot, const std::vector<Vec2>& local) {
  std::vector<Vec2> out;
  for (const Vec2& p : local) out.push_back(on_map(spot, p));
  return out;
}

void draw_shading(Pen& pen, const MapSpot& spot, const MapGround& ground) {
  const Shading& shading = ground.shading;
  std::vector<std::uint32_t> pixels;
  for (const float b : shading.brightness) {  // the last bits are not seen, and cost most
    const auto grey = static_cast<std::uint8_t>((std::isnan(b) ? 255 : std::lround(b)) | 3);
    pixels.push_back(pixel_of({grey, grey, grey, 255}, 1));
  }
  const double cell = mm(spot, ground.shading_cell);
  pen.picture({spot.frame.x, spot.frame.y, shading.n_cols * cell, shading.n_rows * cell},
              shading.n_rows, shading.n_cols, pixels, false);
}

void draw_cells(Pen& pen, const MapSpot& spot, const MapCells& cells) {
  const PassageGrid& grid = cells.grid;
  const Window w = window_of(spot.view, grid);
  const auto class_at = [&cells](std::size_t cell) {
    const float value = cells.value[cell];
    return value == cells.nodata ? nullptr : class_of(cells.style, value);
  };
  std::vector<std::uint32_t> pixels;
  for (int row = w.row_begin; row < w.row_end; ++row)
    for (int col = w.col_begin; col < w.col_end; ++col) {
      const StyleClass* const c = class_at(static_cast<std::size_t>(row) * grid.n_cols + col);
      const Colour white{255, 255, 255, 255};
      pixels.push_back(!c ? 0 : pixel_of(c->is_hatched ? white : c->colour, cell_opacity));
    }
  if (pixels.empty()) return;
  const int n_rows = w.row_end - w.row_begin, n_cols = w.col_end - w.col_begin;
  pen.picture(box_of(spot, grid, w.row_begin, w.col_begin, n_rows, n_cols), n_rows, n_cols, pixels,
              true);
  for (const StyleClass& c : cells.style.classes)
    if (c.is_hatched)
      pen.hatch(stretches(spot, grid, [&](std::size_t cell) { return class_at(cell) == &c; }),
                class_hatch_mm, false, hatch_stroke(c.colour, class_hatch_width));
  if (!cells.uncertain.empty())
    pen.hatch(stretches(spot, grid,
                        [&](std::size_t cell) { return cells.uncertain[cell] && class_at(cell); }),
              uncertain_hatch_mm, true, hatch_stroke({30, 30, 30, 255}));
}

void draw_contours(Pen& pen, const MapSpot& spot, const MapGround& ground) {
  for (const bool numbered : {false, true}) {
    PenLines lines;
    for (const LevelLine& line : ground.contours)
      if (is_numbered(ground, line) == numbered) lines.push_back(on_map(spot, line.points));
    pen.lines(lines, contour_stroke(numbered));
  }
  const Vec2 corner(spot.frame.x, spot.frame.y);
  for (const LevelLabel& label : level_labels(ground, {spot.frame.width, spot.frame.height}))
    pen.words_about(corner + label.at, text(label.level),
                    {2.0 * spot.letters, false, 0, {95, 60, 30, 255}, true}, Anchor::middle,
                    label.angle);
}

void draw_places(Pen& pen, const MapSpot& spot, const MapPlaces& places) {
  PenLines source;
  for (const std::vector<Vec2>& ring : places.source) source.push_back(on_map(spot, ring));
  pen.lines(source, source_stroke(), true);
  for (const RecordObject& object : places.objects) draw_object(pen, spot, object);
  for (const RecordLine& line : places.lines) {
    std::vector<Vec2> points;
    for (const Vec3& p : line.points) points.push_back(on_map(spot, Vec2(p.head<2>())));
    pen.line(points, line_stroke(line.standing));
    pen.note(line.name, {points}, false);
    draw_name(pen, spot, points.back(), line.name, {0, 0, 0, 255});
  }
}

void draw_name(Pen& pen, const MapSpot& spot, const Vec2& beside, const std::string& name,
               const Colour& colour) {
  if (!is_inside(spot.frame, beside)) return;
  const bool is_right = beside.x() > spot.frame.x + 0.8 * spot.frame.width;
  pen.words_about(beside + Vec2(is_right ? -1.2 : 1.2, 0), name,
                  {2.3 * spot.letters, true, 0, colour, true},
                  is_right ? Anchor::end : Anchor::begin);
}

// Lines, and their map coordinates along the frame.
void draw_grid(Pen& pen, const MapSpot& spot, const Vec2& origin) {
  const PageBox& frame = spot.frame;
  const double spacing = (spot.is_whole ? 2 : 1) * grid_spacing(spot.view);
  const Vec2 low = spot.view.low + origin, high = spot.view.high + origin;
  const double right = frame.x + frame.width, bottom = frame.y + frame.height;
  const double from_corner = 8 * spot.letters * (spot.is_whole ? 1.5 : 1);
  const Letters letters{2.1 * spot.letters, false, 0, {30, 30, 30, 255}, spot.is_whole};
  PenLines lines, ticks;
  for (double k = std::ceil(low.x() / spacing); k * spacing <= high.x(); ++k) {
    const double x = frame.x + mm(spot, k * spacing - low.x());
    lines.push_back({{x, frame.y}, {x, bottom}});
    ticks.push_back({{x, bottom}, {x, bottom + 1}});
    if (x > frame.x + from_corner && x < right - from_corner)
      pen.words_about({x, bottom + (spot.is_whole ? -2.5 : 3)}, spaced(k * spacing) + " E",
                      letters);
  }
  for (double k = std::ceil(low.y() / spacing); k * spacing <= high.y(); ++k) {
    const double y = bottom - mm(spot, k * spacing - low.y());
    lines.push_back({{frame.x, y}, {right, y}});
    ticks.push_back({{frame.x - 1, y}, {frame.x, y}});
    const std::string words = spaced(k * spacing) + " N";
    if (y <= frame.y + from_corner || y >= bottom - from_corner) continue;
    if (spot.is_whole)
      pen.words_about({frame.x + 1, y - 2}, words, letters, Anchor::begin);
    else
      pen.words_about({frame.x - 3, y}, words, letters, Anchor::middle, std::numbers::pi / 2);
  }
  pen.lines(lines, {0.1, {0, 0, 0, 70}});
  if (!spot.is_whole) pen.lines(ticks, {0.25});
}

void draw_north(Pen& pen, const Vec2& tip, double letters) {
  const Vec2 left = tip + Vec2(-2.4, 8), right = tip + Vec2(2.4, 8), foot = tip + Vec2(0, 6.2);
  pen.area({{tip, foot, left}}, {0, 0, 0, 255});
  pen.line({tip, right, foot}, {0.2}, true);
  pen.words_about(tip + Vec2(0, 10 * std::sqrt(letters)), "N", {3.2 * letters, true});
}

void draw_scale_bar(Pen& pen, const Vec2& at, const MapView& view, double letters) {
  const double length = bar_length(view), wide = 1000 * length / view.scale;
  for (int k = 0; k < 4; ++k) {
    const PageBox part{at.x() + k * wide / 4, at.y(), wide / 4, 1.6};
    pen.box(part, k % 2 == 0 ? Colour{0, 0, 0, 255} : Colour{255, 255, 255, 255});
    pen.frame(part, {0.15});
  }
  const bool in_km = length >= 2000;
  const Letters of_bar{2.3 * letters, false, 0, {30, 30, 30, 255}, letters > 1};
  const auto words = [&](double share) {
    return text(share * length / (in_km ? 1000 : 1)) + (share == 1 ? in_km ? " km" : " m" : "");
  };
  const auto write = [&](double share) {
    pen.words_about(at + Vec2(share * wide, -2 * letters), words(share), of_bar);
  };
  write(0);
  write(1);
  const double of_both = pen.size_of(words(0.5) + " " + words(1), of_bar).x();
  if (of_both < wide) write(0.5);  // half of each is between their middles
}

Stroke contour_stroke(bool is_numbered) {
  return {is_numbered ? 0.26 : 0.12,
          {110, 75, 40, static_cast<std::uint8_t>(is_numbered ? 200 : 150)}};
}
Stroke source_stroke() { return {0.45, {0, 0, 0, 255}, {1.8, 0.9}, 0.3}; }
Stroke line_stroke(bool stands) {
  if (stands) return {1.0, {0, 0, 0, 255}, {}, 0.3};
  return {0.4, {0, 0, 0, 255}, {0.5, 0.8}, 0.3};
}
Stroke object_stroke() { return {0.5, {0, 90, 178, 255}, {}, 0.3}; }
Stroke hatch_stroke(const Colour& colour, double width) { return {width, colour}; }

std::string spaced(double value) {
  std::string digits =
      value == std::round(value) ? std::to_string(std::llround(value)) : text(value);
  const std::size_t begin = digits.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(digits.find('.'), digits.size());
  for (std::size_t i = end; i > begin + 3; i -= 3) digits.insert(i - 3, "\u202f");
  return digits;
}

Drawing page_drawing(const MapPage& page, const MapGround& ground, const MapPlaces& places) {
  const PageLayout layout = layout_of(page.size);
  return {layout.width, layout.height, page.title, 1,
          [&page, &ground, &places](Pen& pen) { draw_page(pen, page, ground, places); }};
}

}  // namespace talus
