#include "post/maps/map_page_cairo.hpp"

#include <cairo-pdf.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.hpp"
#include "base/text.hpp"
#include "post/maps/map_column_cairo.hpp"
#include "post/maps/page_font_cairo.hpp"
#include "post/maps/pen_cairo.hpp"

namespace talus {
namespace {

constexpr double mm_per_inch = 25.4, points_per_mm = 72 / mm_per_inch;

std::uint32_t pixel_of(const Colour& colour, double opacity) {
  return static_cast<std::uint32_t>(std::lround(opacity * colour[3])) << 24 |
         static_cast<std::uint32_t>(colour[0]) << 16 | static_cast<std::uint32_t>(colour[1]) << 8 |
         colour[2];
}

// The map within its frame.
class MapDrawing {
 public:
  MapDrawing(Pen& pen, const PageBox& frame, const MapPage& page, const MapGround& ground,
             const MapPlaces& places)
      : pen_(pen), frame_(frame), page_(page), ground_(ground), places_(places) {}

  void draw() {
    pen_.clip(frame_);
    draw_shading();
    draw_cells();
    draw_hatches();
    draw_contours();
    draw_places();
    draw_heights();
    pen_.unclip();
    draw_grid();
    pen_.frame(frame_, {0.35});
  }

 private:
  [[nodiscard]] double mm(double metres) const { return 1000 * metres / ground_.view.scale; }
  [[nodiscard]] Vec2 at(const Vec2& local) const {
    return {frame_.x + mm(local.x() - ground_.view.low.x()),
            frame_.y + mm(ground_.view.high.y() - local.y())};
  }
  [[nodiscard]] std::vector<Vec2> at(const std::vector<Vec2>& local) const {
    std::vector<Vec2> out;
    for (const Vec2& p : local) out.push_back(at(p));
    return out;
  }
  [[nodiscard]] bool is_inside(const Vec2& p, double margin) const {
    return p.x() > frame_.x + margin && p.x() < frame_.x + frame_.width - margin &&
           p.y() > frame_.y + margin && p.y() < frame_.y + frame_.height - margin;
  }

  void draw_shading() {
    const Shading& shading = ground_.shading;
    std::vector<std::uint32_t> pixels;
    for (const float b : shading.brightness) {
      const auto grey = static_cast<std::uint8_t>(std::isnan(b) ? 255 : std::lround(b));
      pixels.push_back(pixel_of({grey, grey, grey, 255}, 1));
    }
    const double cell = mm(ground_.shading_cell);
    pen_.picture({frame_.x, frame_.y, shading.n_cols * cell, shading.n_rows * cell}, shading.n_rows,
                 shading.n_cols, pixels, false);
  }

  // Rows and columns of the cells in the frame.
  struct Window {
    int row_begin, row_end, col_begin, col_end;
  };
  [[nodiscard]] Window window() const {
    const PassageGrid& grid = page_.grid;
    const Vec2 low = (ground_.view.low - grid.corner) / grid.cell_size,
               high = (ground_.view.high - grid.corner) / grid.cell_size;
    const auto limited = [](double value, int n) {
      return static_cast<int>(std::clamp(value, 0.0, 1.0 * n));
    };
    return {limited(std::floor(-high.y()), grid.n_rows), limited(std::ceil(-low.y()), grid.n_rows),
            limited(std::floor(low.x()), grid.n_cols), limited(std::ceil(high.x()), grid.n_cols)};
  }
  [[nodiscard]] PageBox box_of(int row, int col, int n_rows, int n_cols) const {
    const double cell = page_.grid.cell_size;
    const Vec2 corner = at(Vec2(page_.grid.corner + cell * Vec2(col, -row)));
    return {corner.x(), corner.y(), n_cols * mm(cell), n_rows * mm(cell)};
  }
  [[nodiscard]] std::size_t index(int row, int col) const {
    return static_cast<std::size_t>(row) * page_.grid.n_cols + col;
  }
  [[nodiscard]] const StyleClass* class_at(int row, int col) const {
    const float value = page_.value[index(row, col)];
    return value == page_.nodata ? nullptr : class_of(page_.style, value);
  }

  void draw_cells() {
    const Window w = window();
    if (w.row_begin >= w.row_end || w.col_begin >= w.col_end) return;
    std::vector<std::uint32_t> pixels;
    for (int row = w.row_begin; row < w.row_end; ++row)
      for (int col = w.col_begin; col < w.col_end; ++col) {
        const StyleClass* const c = class_at(row, col);
        const Colour white{255, 255, 255, 255};
        pixels.push_back(!c ? 0 : pixel_of(c->is_hatched ? white : c->colour, cell_opacity));
      }
    const int n_rows = w.row_end - w.row_begin, n_cols = w.col_end - w.col_begin;
    pen_.picture(box_of(w.row_begin, w.col_begin, n_rows, n_cols), n_rows, n_cols, pixels, true);
  }

  void draw_hatches() {
    const Window w = window();
    for (int row = w.row_begin; row < w.row_end; ++row)
      for (int col = w.col_begin; col < w.col_end; ++col) {
        const StyleClass* const c = class_at(row, col);
        if (c && c->is_hatched)
          pen_.hatch(box_of(row, col, 1, 1), class_hatch_mm, false,
                     hatch_stroke(c->colour, class_hatch_width));
        if (c && !page_.uncertain.empty() && page_.uncertain[index(row, col)])
          pen_.hatch(box_of(row, col, 1, 1), uncertain_hatch_mm, true,
                     hatch_stroke({30, 30, 30, 255}));
      }
  }

  void draw_contours() {
    for (const bool numbered : {false, true})
      for (const LevelLine& line : ground_.contours)
        if (is_numbered(ground_, line) == numbered)
          pen_.line(at(line.points), contour_stroke(numbered));
  }
  void draw_heights() {
    for (const LevelLabel& label : level_labels(ground_, {frame_.width, frame_.height}))
      pen_.words_about(Vec2(frame_.x, frame_.y) + label.at, label.angle, text(label.level),
                       {2.0, false, 0, {95, 60, 30, 255}, true});
  }
  void draw_places() {
    draw_source();
    for (const RecordObject& object : places_.objects) draw_object(object);
    for (const RecordLine& line : places_.lines) {
      std::vector<Vec2> points;
      for (const Vec3& p : line.points) points.push_back(at(Vec2(p.head<2>())));
      pen_.line(points, line_stroke(line.standing));
      draw_name(points.back(), line.name, {0, 0, 0, 255});
    }
  }

  void draw_name(const Vec2& beside, const std::string& name, const Colour& colour) {
    if (!is_inside(beside, 0)) return;
    const Letters letters{2.3, true, 0, colour, true};
    const Vec2 size = pen_.size_of(name, letters);
    const double right = frame_.x + frame_.width - 1;
    const double x =
        beside.x() + 1.2 + size.x() < right ? beside.x() + 1.2 : beside.x() - 1.2 - size.x();
    pen_.words({x, beside.y() - size.y() / 2}, name, letters);
  }

  void draw_object(const RecordObject& object) {
    const Stroke stroke = object_stroke();
    Vec2 last = Vec2::Constant(-1);
    for (const ObjectPart& part : object.parts) {
      if (part.points.empty()) continue;
      const std::vector<Vec2> points = at(part.points);
      if (part.is_area || points.size() > 1)
        pen_.line(points, stroke, part.is_area);
      else
        pen_.circle(points[0], std::max(1.0, mm(object.radius)), stroke);
      last = *std::max_element(points.begin(), points.end(),
                               [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
    }
    draw_name(last, object.name, stroke.colour);
  }

  // The rim of all blocks together: the line of half cover on a fine mask.
  void draw_source() {
    if (places_.source.empty()) return;
    constexpr double per_mm = 6;
    const int n_cols = static_cast<int>(frame_.width * per_mm),
              n_rows = static_cast<int>(frame_.height * per_mm);
    cairo_surface_t* const mask = cairo_image_surface_create(CAIRO_FORMAT_A8, n_cols, n_rows);
    cairo_t* const cover = cairo_create(mask);
    cairo_set_operator(cover, CAIRO_OPERATOR_ADD);  // neighbours leave no seam
    for (const std::vector<Vec2>& ring : places_.source) {
      for (const Vec2& p : ring) {
        const Vec2 to = per_mm * (at(p) - Vec2(frame_.x, frame_.y));
        cairo_line_to(cover, to.x(), to.y());
      }
      cairo_close_path(cover);
      cairo_fill(cover);
    }
    cairo_destroy(cover);
    cairo_surface_flush(mask);
    SampledField field{{0, 0}, 1, n_rows, n_cols, {}};
    const unsigned char* const bytes = cairo_image_surface_get_data(mask);
    for (int r = 0; bytes && r < n_rows; ++r) {
      const unsigned char* const row =
          bytes + static_cast<std::size_t>(r) * cairo_image_surface_get_stride(mask);
      field.value.insert(field.value.end(), row, row + n_cols);
    }
    cairo_surface_destroy(mask);
    constexpr double half = 127.5;
    for (const LevelLine& line : level_lines(field, {half})) {
      std::vector<Vec2> points;
      for (const Vec2& p : line.points)
        points.push_back(Vec2(frame_.x, frame_.y) + Vec2(p.x() + 0.5, -p.y() + 0.5) / per_mm);
      pen_.line(points, source_stroke());
    }
  }

  // Lines, and their map coordinates along the frame.
  void draw_grid() {
    const double spacing = grid_spacing(ground_.view);
    const Vec2 low = ground_.view.low + page_.origin, high = ground_.view.high + page_.origin;
    const Stroke thin{0.1, {0, 0, 0, 70}}, tick{0.25};
    const double right = frame_.x + frame_.width, bottom = frame_.y + frame_.height;
    for (double k = std::ceil(low.x() / spacing); k * spacing <= high.x(); ++k) {
      const double x = frame_.x + mm(k * spacing - low.x());
      pen_.line({{x, frame_.y}, {x, bottom}}, thin);
      pen_.line({{x, bottom}, {x, bottom + 1}}, tick);
      if (x > frame_.x + 8 && x < right - 8)
        pen_.words_about({x, bottom + 3}, 0, spaced(k * spacing) + " E", {2.1});
    }
    for (double k = std::ceil(low.y() / spacing); k * spacing <= high.y(); ++k) {
      const double y = bottom - mm(k * spacing - low.y());
      pen_.line({{frame_.x, y}, {right, y}}, thin);
      pen_.line({{frame_.x - 1, y}, {frame_.x, y}}, tick);
      if (y > frame_.y + 8 && y < bottom - 8)
        pen_.words_about({frame_.x - 3, y}, M_PI / 2, spaced(k * spacing) + " N", {2.1});
    }
  }

  Pen& pen_;
  const PageBox frame_;
  const MapPage& page_;
  const MapGround& ground_;
  const MapPlaces& places_;
};

// As large as fits into a width.
void fitted_words(Pen& pen, const Vec2& at, double width, const std::string& words,
                  Letters letters) {
  letters.size *= std::min(1.0, width / pen.size_of(words, letters).x());
  pen.words(at, words, letters);
}

ColumnHeights measured(const PageLayout& layout, const MapPage& page, const MapGround& ground,
                       const MapPlaces& places) {
  cairo_surface_t* const nowhere =
      cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr);
  cairo_t* const at = cairo_create(nowhere);
  ColumnHeights heights;
  {
    Pen pen(at);
    heights = draw_column(pen, layout.column, layout.column.y, page, ground, places);
  }
  cairo_destroy(at);
  cairo_surface_destroy(nowhere);
  return heights;
}

void draw_page(cairo_t* to, const MapPage& page, const MapGround& ground, const MapPlaces& places) {
  const PageLayout layout = layout_of(page.size);
  Pen pen(to);
  pen.box({0, 0, layout.width, layout.height}, {255, 255, 255, 255});
  const double left = layout.map.x, width = layout.width - 2 * 8;
  if (!page.style.remark.empty()) {  // that nobody may miss
    pen.box({0, 0, layout.width, 7}, {179, 32, 31, 255});
    fitted_words(pen, {8, 1.6}, width, page.style.remark, {3.2, true, 0, {255, 255, 255, 255}});
  }
  fitted_words(pen, {left, 8}, layout.width - left - 8, page.title, {5, true});
  fitted_words(pen, {left, 15}, layout.width - left - 8, page.subtitle,
               {2.9, false, 0, {70, 70, 70, 255}});
  MapDrawing(pen, layout.map, page, ground, places).draw();

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

cairo_status_t append(void* to, const unsigned char* bytes, unsigned n) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

// Draws in millimetres on a surface, which is then given back.
void draw_on(cairo_surface_t* surface, double units_per_mm, const MapPage& page,
             const MapGround& ground, const MapPlaces& places) {
  cairo_t* const to = cairo_create(surface);
  cairo_scale(to, units_per_mm, units_per_mm);
  draw_page(to, page, ground, places);
  cairo_show_page(to);
  const cairo_status_t status = cairo_status(to);
  cairo_destroy(to);
  if (status == CAIRO_STATUS_SUCCESS) return;
  cairo_surface_destroy(surface);
  throw InputError({}, std::string("a map cannot be drawn: ") + cairo_status_to_string(status));
}

// What the eye does not see in the ground's brightness makes a file three times as large.
void leave_out_last_bits(cairo_surface_t* picture) {
  cairo_surface_flush(picture);
  unsigned char* const bytes = cairo_image_surface_get_data(picture);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(picture));
  const auto n_rows = static_cast<std::size_t>(cairo_image_surface_get_height(picture));
  if (bytes)
    std::for_each(bytes, bytes + stride * n_rows, [](unsigned char& value) { value |= 3; });
  cairo_surface_mark_dirty(picture);
}

std::string drawn(cairo_surface_t* surface, std::string& bytes, cairo_status_t status) {
  cairo_surface_destroy(surface);
  if (status != CAIRO_STATUS_SUCCESS)
    throw InputError({}, std::string("a map cannot be drawn: ") + cairo_status_to_string(status));
  return std::move(bytes);
}

}  // namespace

std::string map_page_png(const MapPage& page, const MapGround& ground, const MapPlaces& places) {
  require_font();
  const PageLayout layout = layout_of(page.size);
  const double per_mm = picture_dpi / mm_per_inch;
  cairo_surface_t* const surface = cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(layout.width * per_mm)),
      static_cast<int>(std::lround(layout.height * per_mm)));
  draw_on(surface, per_mm, page, ground, places);
  leave_out_last_bits(surface);
  std::string bytes;
  return drawn(surface, bytes, cairo_surface_write_to_png_stream(surface, append, &bytes));
}

std::string map_page_pdf(const MapPage& page, const MapGround& ground, const MapPlaces& places) {
  require_font();
  const PageLayout layout = layout_of(page.size);
  std::string bytes;
  cairo_surface_t* const surface = cairo_pdf_surface_create_for_stream(
      append, &bytes, layout.width * points_per_mm, layout.height * points_per_mm);
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, page.title.c_str());
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");  // no time at all
  draw_on(surface, points_per_mm, page, ground, places);
  cairo_surface_finish(surface);
  return drawn(surface, bytes, cairo_surface_status(surface));
}

}  // namespace talus
