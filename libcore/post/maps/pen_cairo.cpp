#include "post/maps/pen_cairo.hpp"

#include <cairo.h>
#include <pango/pangocairo.h>

#include <cmath>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "post/maps/page_font_cairo.hpp"

namespace talus {

struct Pen::Words {
  explicit Words(cairo_t* page) : layout(pango_cairo_create_layout(page)) {
    PangoContext* const context = pango_layout_get_context(layout);
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(context, options);
    cairo_font_options_destroy(options);
    pango_context_set_round_glyph_positions(context, FALSE);
  }
  ~Words() { g_object_unref(layout); }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;

  PangoLayout* layout;
};

namespace {

void use(cairo_t* page, const Colour& colour) {
  cairo_set_source_rgba(page, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0,
                        colour[3] / 255.0);
}

void trace(cairo_t* page, const std::vector<Vec2>& points, bool is_closed) {
  cairo_new_path(page);
  for (const Vec2& p : points) cairo_line_to(page, p.x(), p.y());
  if (is_closed) cairo_close_path(page);
}

constexpr Colour casing{255, 255, 255, 190};
constexpr double casing_width = 0.3;  // on each side [mm]

}  // namespace

Pen::Pen(_cairo* page) : page_(page), words_(std::make_unique<Words>(page)) {
  cairo_set_line_join(page_, CAIRO_LINE_JOIN_ROUND);
}

Pen::~Pen() = default;

void Pen::stroke(const Stroke& stroke) {
  if (stroke.has_casing) {
    use(page_, casing);
    cairo_set_line_width(page_, stroke.width + 2 * casing_width);
    cairo_stroke_preserve(page_);
  }
  use(page_, stroke.colour);
  cairo_set_line_width(page_, stroke.width);
  cairo_set_dash(page_, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
  cairo_stroke(page_);
  cairo_set_dash(page_, nullptr, 0, 0);
}

void Pen::line(const std::vector<Vec2>& points, const Stroke& stroke, bool is_closed) {
  trace(page_, points, is_closed);
  this->stroke(stroke);
}

void Pen::area(const std::vector<Vec2>& points, const Colour& colour) {
  trace(page_, points, true);
  use(page_, colour);
  cairo_fill(page_);
}

void Pen::box(const PageBox& box, const Colour& colour) {
  cairo_rectangle(page_, box.x, box.y, box.width, box.height);
  use(page_, colour);
  cairo_fill(page_);
}

void Pen::frame(const PageBox& box, const Stroke& stroke) {
  cairo_rectangle(page_, box.x, box.y, box.width, box.height);
  this->stroke(stroke);
}

void Pen::circle(const Vec2& middle, double radius, const Stroke& stroke) {
  cairo_new_path(page_);
  cairo_arc(page_, middle.x(), middle.y(), radius, 0, 2 * M_PI);
  this->stroke(stroke);
}

void Pen::hatch(const PageBox& box, double distance, bool rises, const Stroke& stroke) {
  // lines x + sign * y = k * distance
  const double sign = rises ? 1 : -1, right = box.x + box.width, bottom = box.y + box.height;
  const double first = box.x + sign * (rises ? box.y : bottom),
               last = right + sign * (rises ? bottom : box.y);
  cairo_new_path(page_);
  for (double k = std::ceil(first / distance); k * distance <= last; ++k) {
    const double sum = k * distance, at_left = sign * (sum - box.x),
                 at_right = sign * (sum - right);
    const double top = std::max(box.y, std::min(at_left, at_right)),
                 end = std::min(bottom, std::max(at_left, at_right));
    if (!(top < end)) continue;
    cairo_move_to(page_, sum - sign * top, top);
    cairo_line_to(page_, sum - sign * end, end);
  }
  this->stroke(stroke);
}

void Pen::set(const std::string& words, const Letters& letters) {
  PangoFontDescription* const font = pango_font_description_new();
  pango_font_description_set_family(font, page_font);
  pango_font_description_set_weight(font,
                                    letters.is_bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(font, letters.size * PANGO_SCALE);
  pango_layout_set_font_description(words_->layout, font);
  pango_font_description_free(font);
  pango_layout_set_width(words_->layout,
                         letters.width > 0 ? static_cast<int>(letters.width * PANGO_SCALE) : -1);
  pango_layout_set_wrap(words_->layout, PANGO_WRAP_WORD_CHAR);
  const std::string shown = printable(words);
  pango_layout_set_text(words_->layout, shown.data(), static_cast<int>(shown.size()));
  pango_cairo_update_layout(page_, words_->layout);
}

void Pen::show(const Vec2& at, const Letters& letters) {
  cairo_move_to(page_, at.x(), at.y());
  if (letters.has_halo) {
    pango_cairo_layout_path(page_, words_->layout);
    stroke({0.2 * letters.size, {255, 255, 255, 210}});
    cairo_move_to(page_, at.x(), at.y());
  }
  use(page_, letters.colour);
  pango_cairo_show_layout(page_, words_->layout);
  cairo_new_path(page_);
}

Vec2 Pen::size_of(const std::string& words, const Letters& letters) {
  set(words, letters);
  int width = 0, height = 0;
  pango_layout_get_size(words_->layout, &width, &height);
  return Vec2(width, height) / PANGO_SCALE;
}

double Pen::words(const Vec2& at, const std::string& words, const Letters& letters) {
  const Vec2 size = size_of(words, letters);
  show(at, letters);
  return size.y();
}

void Pen::words_about(const Vec2& at, double angle, const std::string& words,
                      const Letters& letters) {
  cairo_save(page_);
  cairo_translate(page_, at.x(), at.y());
  cairo_rotate(page_, -angle);
  const Vec2 size = size_of(words, letters);
  show(-size / 2, letters);
  cairo_restore(page_);
}

void Pen::picture(const PageBox& box, int n_rows, int n_cols,
                  const std::vector<std::uint32_t>& pixels, bool is_sharp) {
  cairo_surface_t* const image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, n_cols, n_rows);
  cairo_surface_flush(image);
  unsigned char* const bytes = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int r = 0; bytes && r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) {
      const std::uint32_t from = pixels[static_cast<std::size_t>(r) * n_cols + c];
      const std::uint32_t alpha = from >> 24;
      std::uint32_t to = alpha << 24;
      for (const int shift : {0, 8, 16})
        to |= (((from >> shift) & 0xff) * alpha + 127) / 255 << shift;
      reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::size_t>(r) * stride)[c] = to;
    }
  cairo_surface_mark_dirty(image);
  cairo_save(page_);
  cairo_rectangle(page_, box.x, box.y, box.width, box.height);
  cairo_clip(page_);
  cairo_translate(page_, box.x, box.y);
  cairo_scale(page_, box.width / n_cols, box.height / n_rows);
  cairo_set_source_surface(page_, image, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(page_),
                           is_sharp ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_BILINEAR);
  cairo_pattern_set_extend(cairo_get_source(page_), CAIRO_EXTEND_PAD);
  cairo_paint(page_);
  cairo_restore(page_);
  cairo_surface_destroy(image);
}

void Pen::clip(const PageBox& box) {
  cairo_save(page_);
  cairo_rectangle(page_, box.x, box.y, box.width, box.height);
  cairo_clip(page_);
}

void Pen::unclip() { cairo_restore(page_); }

void Pen::shrink(const Vec2& at, double factor) {
  cairo_translate(page_, at.x(), at.y());
  cairo_scale(page_, factor, factor);
  cairo_translate(page_, -at.x(), -at.y());
}

}  // namespace talus
