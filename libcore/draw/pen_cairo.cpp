// Strokes by Cairo, words by Pango. The pen itself knows where its units are on the surface, so
// that an SVG has plain coordinates; there, words stay words.
#include <cairo.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>

#include "base/printable.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "draw/drawing.hpp"
#include "draw/pen_surface_cairo.hpp"

namespace talus {
namespace {

constexpr Colour casing{255, 255, 255, 190}, halo{255, 255, 255, 210};
constexpr double halo_width = 0.2;  // of the letters' size

void use(cairo_t* page, const Colour& colour) {
  cairo_set_source_rgba(page, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0,
                        colour[3] / 255.0);
}

std::string px(double value) { return text(std::round(100 * value) / 100); }

std::string css(const Colour& colour) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string out = "#";
  for (std::size_t k = 0; k < (colour[3] < 255 ? 4 : 3); ++k)
    out += {digits[colour[k] >> 4], digits[colour[k] & 15]};
  return out;
}

// Words of an SVG, in parts of its font size.
std::string text_element(const Vec2& at, double angle, const Letters& letters, double size,
                         const std::string& more, std::string_view words) {
  const std::string where = angle == 0 ? "x=\"" + px(at.x()) + "\" y=\"" + px(at.y())
                                       : "transform=\"translate(" + px(at.x()) + " " + px(at.y()) +
                                             ")rotate(" + px(-angle / degree) + ")";
  return "<text " + where + "\" font-size=\"" + px(size / base_letters) + "em\" fill=\"" +
         css(letters.colour) + "\"" + (letters.is_bold ? " font-weight=\"bold\"" : "") +
         (letters.has_halo ? " paint-order=\"stroke\" stroke=\"" + css(halo) +
                                 "\" stroke-width=\"" + px(halo_width) + "em\""
                           : "") +
         more + ">" + xml_escaped(printable(words)) + "</text>\n";
}

}  // namespace

Pen::Surface::Surface(_cairo* to, double unit_of, bool svg) : page(to), unit(unit_of), is_svg(svg) {
  cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
}

Pen::Surface::~Surface() {
  if (layout != nullptr) g_object_unref(layout);
}

void Pen::Surface::set(const std::string& shown, const Letters& letters) {
  if (layout == nullptr) {
    require_font();
    layout = pango_cairo_create_layout(page);
    PangoContext* const context = pango_layout_get_context(layout);
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    pango_cairo_context_set_font_options(context, options);
    cairo_font_options_destroy(options);
    pango_context_set_round_glyph_positions(context, FALSE);
  }
  PangoFontDescription* const font = pango_font_description_new();
  pango_font_description_set_family(font, page_font);
  pango_font_description_set_weight(font,
                                    letters.is_bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(font, unit * letters.size * PANGO_SCALE);
  pango_layout_set_font_description(layout, font);
  pango_font_description_free(font);
  pango_layout_set_width(
      layout, letters.width > 0 ? static_cast<int>(unit * letters.width * PANGO_SCALE) : -1);
  pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
  const std::string plain = printable(shown);
  pango_layout_set_text(layout, plain.data(), static_cast<int>(plain.size()));
  pango_cairo_update_layout(page, layout);
}

// --- strokes -----------------------------------------------------------------------------------

void Pen::trace(const PenLines& lines, bool is_closed) {
  cairo_new_path(surface_.page);
  for (const std::vector<Vec2>& line : lines) {
    cairo_new_sub_path(surface_.page);
    for (const Vec2& p : line) {
      const Vec2 q = surface_.at(p);
      cairo_line_to(surface_.page, q.x(), q.y());
    }
    if (is_closed && !line.empty()) cairo_close_path(surface_.page);
  }
}

void Pen::stroke(const Stroke& stroke) {
  cairo_t* const page = surface_.page;
  if (stroke.casing > 0) {
    use(page, casing);
    cairo_set_line_width(page, surface_.unit * (stroke.width + 2 * stroke.casing));
    cairo_stroke_preserve(page);
  }
  use(page, stroke.colour);
  cairo_set_line_width(page, surface_.unit * stroke.width);
  std::vector<double> dashes;
  for (const double length : stroke.dashes) dashes.push_back(surface_.unit * length);
  cairo_set_dash(page, dashes.data(), static_cast<int>(dashes.size()), 0);
  cairo_stroke(page);
  cairo_set_dash(page, nullptr, 0, 0);
}

void Pen::fill(const Colour& colour) {
  use(surface_.page, colour);
  cairo_fill(surface_.page);
}

void Pen::lines(const PenLines& lines, const Stroke& stroke, bool is_closed) {
  trace(lines, is_closed);
  this->stroke(stroke);
}

void Pen::line(const std::vector<Vec2>& points, const Stroke& stroke, bool is_closed) {
  lines({points}, stroke, is_closed);
}

void Pen::areas(const PenLines& rings, const Colour& colour) {
  trace(rings, true);
  fill(colour);
}

void Pen::area(const PenLines& rings, const Colour& colour) {
  cairo_set_fill_rule(surface_.page, CAIRO_FILL_RULE_EVEN_ODD);
  areas(rings, colour);
  cairo_set_fill_rule(surface_.page, CAIRO_FILL_RULE_WINDING);
}

namespace {

std::vector<Vec2> corners_of(const PageBox& box) {
  const double right = box.x + box.width, bottom = box.y + box.height;
  return {{box.x, box.y}, {right, box.y}, {right, bottom}, {box.x, bottom}};
}

}  // namespace

void Pen::box(const PageBox& box, const Colour& colour) {
  trace({corners_of(box)}, true);
  fill(colour);
}

void Pen::frame(const PageBox& box, const Stroke& stroke) { line(corners_of(box), stroke, true); }

void Pen::circles(const std::vector<Vec2>& middles, double radius, const Stroke& stroke) {
  cairo_new_path(surface_.page);
  for (const Vec2& middle : middles) {
    const Vec2 at = surface_.at(middle);
    cairo_new_sub_path(surface_.page);
    cairo_arc(surface_.page, at.x(), at.y(), surface_.unit * radius, 0, 2 * M_PI);
    cairo_close_path(surface_.page);
  }
  if (stroke.width > 0)
    this->stroke(stroke);
  else
    fill(stroke.colour);
}

void Pen::dots(const std::vector<Vec2>& middles, double radius, const Colour& colour) {
  circles(middles, radius, {0, colour});
}

void Pen::hatch(const std::vector<PageBox>& boxes, double distance, bool rises,
                const Stroke& stroke) {
  if (boxes.empty()) return;
  PenLines rims, all;
  Vec2 low = Vec2::Constant(INFINITY), high = -low;
  for (const PageBox& box : boxes) {
    rims.push_back(corners_of(box));
    low = low.cwiseMin(rims.back()[0]);
    high = high.cwiseMax(rims.back()[2]);
  }
  // lines x + sign * y = k * distance
  const double sign = rises ? 1 : -1;
  const double first = low.x() + sign * (rises ? low.y() : high.y()),
               last = high.x() + sign * (rises ? high.y() : low.y());
  for (double k = std::ceil(first / distance); k * distance <= last; ++k) {
    const double sum = k * distance;
    all.push_back({{sum - sign * low.y(), low.y()}, {sum - sign * high.y(), high.y()}});
  }
  cairo_save(surface_.page);
  trace(rims, true);
  cairo_clip(surface_.page);
  lines(all, stroke);
  cairo_restore(surface_.page);
}

void Pen::picture(const PageBox& box, int n_rows, int n_cols,
                  const std::vector<std::uint32_t>& pixels, bool is_sharp) {
  cairo_t* const page = surface_.page;
  const bool is_opaque = std::all_of(pixels.begin(), pixels.end(),
                                     [](std::uint32_t pixel) { return pixel >> 24 == 255; });
  cairo_surface_t* const image = cairo_image_surface_create(
      is_opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32, n_cols, n_rows);
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
  cairo_save(page);
  if (!surface_.is_svg) {
    trace({corners_of(box)}, true);
    cairo_clip(page);
  }
  const Vec2 at = surface_.at({box.x, box.y});
  cairo_translate(page, at.x(), at.y());
  cairo_scale(page, surface_.unit * box.width / n_cols, surface_.unit * box.height / n_rows);
  cairo_set_source_surface(page, image, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(page),
                           is_sharp ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_BILINEAR);
  if (!surface_.is_svg) cairo_pattern_set_extend(cairo_get_source(page), CAIRO_EXTEND_PAD);
  cairo_paint(page);
  cairo_restore(page);
  cairo_surface_destroy(image);
  surface_.is_sharp |= is_sharp;
}

void Pen::clip(const PageBox& box) {
  cairo_save(surface_.page);
  trace({corners_of(box)}, true);
  cairo_clip(surface_.page);
}

void Pen::unclip() { cairo_restore(surface_.page); }

void Pen::shrink(const Vec2& at, double factor) {
  surface_.zero += surface_.unit * (1 - factor) * at;
  surface_.unit *= factor;
}

// --- words -------------------------------------------------------------------------------------

Vec2 Pen::size_of(const std::string& words, const Letters& letters) {
  surface_.set(words, letters);
  int width = 0, height = 0;
  pango_layout_get_size(surface_.layout, &width, &height);
  return Vec2(width, height) / (surface_.unit * PANGO_SCALE);
}

// The layout that is set, its upper left corner at a point of the surface.
void Pen::show(const Vec2& at, const Letters& letters) {
  cairo_t* const page = surface_.page;
  cairo_move_to(page, at.x(), at.y());
  if (letters.has_halo) {
    pango_cairo_layout_path(page, surface_.layout);
    stroke({halo_width * letters.size, halo});
    cairo_move_to(page, at.x(), at.y());
  }
  use(page, letters.colour);
  pango_cairo_show_layout(page, surface_.layout);
  cairo_new_path(page);
}

double Pen::words(const Vec2& at, const std::string& words, const Letters& letters) {
  const Vec2 size = size_of(words, letters), corner = surface_.at(at);
  if (!surface_.is_svg) {
    show(corner, letters);
    return size.y();
  }
  const char* const shown = pango_layout_get_text(surface_.layout);
  PangoLayoutIter* const line = pango_layout_get_iter(surface_.layout);
  do {
    const PangoLayoutLine* const found = pango_layout_iter_get_line_readonly(line);
    const double below = 1.0 * pango_layout_iter_get_baseline(line) / PANGO_SCALE;
    surface_.words +=
        text_element(corner + Vec2(0, below), 0, letters, surface_.unit * letters.size, "",
                     {shown + found->start_index, static_cast<std::size_t>(found->length)});
  } while (pango_layout_iter_next_line(line));
  pango_layout_iter_free(line);
  return size.y();
}

void Pen::words_about(const Vec2& at, const std::string& words, const Letters& letters,
                      Anchor anchor, double angle) {
  const Vec2 place = surface_.at(at);
  if (surface_.is_svg) {
    constexpr const char* anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    surface_.words +=
        text_element(place, angle, letters, surface_.unit * letters.size,
                     std::string(anchors[static_cast<int>(anchor)]) + " dy=\".35em\"", words);
    return;
  }
  const Vec2 size = surface_.unit * size_of(words, letters);
  const double share = anchor == Anchor::begin ? 0 : anchor == Anchor::middle ? 0.5 : 1;
  cairo_save(surface_.page);
  cairo_translate(surface_.page, place.x(), place.y());
  cairo_rotate(surface_.page, -angle);
  show({-share * size.x(), -size.y() / 2}, letters);
  cairo_restore(surface_.page);
}

void Pen::note(const std::string& title, const PenLines& lines, bool is_area) {
  if (!surface_.is_svg || title.empty()) return;
  std::string path;
  for (const std::vector<Vec2>& line : lines) {
    for (const Vec2& p : line) {
      const Vec2 q = surface_.at(p);
      path += (&p == line.data() ? "M" : "L") + text(std::round(10 * q.x()) / 10) + " " +
              text(std::round(10 * q.y()) / 10);
    }
    if (is_area) path += "Z";
  }
  surface_.notes += "<path pointer-events=\"" + std::string(is_area ? "all" : "stroke") +
                    "\" d=\"" + path + "\"><title>" + xml_escaped(printable(title)) +
                    "</title></path>\n";
}

}  // namespace talus
