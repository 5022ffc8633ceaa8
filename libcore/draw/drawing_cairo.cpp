// Surfaces of Cairo, and its SVG made small.
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <new>

#include "base/error.hpp"
#include "base/text.hpp"
#include "draw/drawing.hpp"
#include "draw/pen_surface_cairo.hpp"

namespace talus {
namespace {

constexpr double mm_per_inch = 25.4, points_per_mm = 72 / mm_per_inch;

cairo_status_t append(void* to, const unsigned char* bytes, unsigned n) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw InputError({},
                     std::string("a picture cannot be drawn: ") + cairo_status_to_string(status));
}

// A surface that is given back whatever is thrown.
struct Held {
  explicit Held(cairo_surface_t* made) : surface(made) {}
  ~Held() { cairo_surface_destroy(surface); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  cairo_surface_t* surface;
};

struct SvgParts {
  std::string words, notes;
  bool is_sharp = false;
};

SvgParts draw_on(cairo_surface_t* surface, double unit, bool is_svg,
                 const std::function<void(Pen&)>& draw) {
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(surface),
                                                                &cairo_destroy);
  Pen::Surface on(page.get(), unit, is_svg);
  Pen pen(on);
  draw(pen);
  cairo_show_page(page.get());
  require(cairo_status(page.get()));
  return {std::move(on.words), std::move(on.notes), on.is_sharp};
}

void draw_on_white(cairo_surface_t* surface, double unit, const Drawing& drawing) {
  draw_on(surface, unit, false, [&drawing](Pen& pen) {
    pen.box({-1, -1, drawing.width + 2, drawing.height + 2}, rgb(0xffffff));
    drawing.draw(pen);
  });
}

// Differences of brightness that the eye does not see make a file three times as large.
void leave_out_last_bits(cairo_surface_t* picture) {
  cairo_surface_flush(picture);
  unsigned char* const bytes = cairo_image_surface_get_data(picture);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(picture));
  const auto n_rows = static_cast<std::size_t>(cairo_image_surface_get_height(picture));
  if (bytes)
    std::for_each(bytes, bytes + stride * n_rows, [](unsigned char& value) { value |= 3; });
  cairo_surface_mark_dirty(picture);
}

// --- SVG ---------------------------------------------------------------------------------------

// The coordinates of a path to a hundredth, and no sign twice.
std::string short_path(std::string_view path) {
  std::string out;
  while (!path.empty()) {
    const char c = path.front();
    const bool is_number = c == '-' || (c >= '0' && c <= '9');
    if (!is_number) {
      if (c != ' ') out += c;
      path.remove_prefix(1);
      continue;
    }
    double value = 0;
    const char* const end = std::from_chars(path.begin(), path.end(), value).ptr;
    if (!out.empty() && out.back() <= '9') out += ' ';
    out += text(std::round(100 * value) / 100);
    path.remove_prefix(static_cast<std::size_t>(end - path.begin()));
  }
  const std::size_t last = out.rfind('Z');  // Cairo ends with a move to where the ring began
  if (last != std::string::npos && out.find_first_of("LC", last) == std::string::npos)
    out.resize(last + 1);
  return out;
}

void erase_all(std::string& from, std::string_view what) {
  for (std::size_t at = from.find(what); at != std::string::npos; at = from.find(what, at))
    from.erase(at, what.size());
}

// A name from the content: equal for equal drawings, different for different ones.
std::string name_of(const std::string& content) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char c : content) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  std::string out = "p";
  for (int k = 0; k < 8; ++k, hash >>= 5) out += static_cast<char>('a' + hash % 26);
  return out;
}

// Content between the tags of Cairo's document: no defaults, short paths. Cairo counts its names
// through all documents; here they are of the drawing alone.
std::string strokes_of(const std::string& document) {
  const std::size_t first = document.find('>', document.find("<svg")) + 1,
                    last = document.rfind("</svg>");
  std::string out;
  std::string_view rest = std::string_view(document).substr(first, last - first);
  constexpr std::array<std::string_view, 3> marks = {" d=\"", " id=\"", "#"};
  std::vector<std::string_view> names;
  std::vector<std::size_t> places;  // of the names in `out`
  for (;;) {
    std::size_t at = std::string_view::npos;
    std::string_view mark;
    for (const std::string_view m : marks)
      if (const std::size_t found = rest.find(m); found < at) at = found, mark = m;
    out += rest.substr(0, at);
    if (at == std::string_view::npos) break;
    rest.remove_prefix(at + mark.size());
    out += mark;
    const std::string_view value = rest.substr(0, rest.find_first_of("\")"));
    rest.remove_prefix(value.size());
    if (mark == marks[0]) {
      out += short_path(value);
      continue;
    }
    const auto known = std::find(names.begin(), names.end(), value) - names.begin();
    if (known == std::ssize(names)) names.push_back(value);
    places.push_back(out.size());
    out += std::to_string(known);
  }
  const std::string name = name_of(out);
  for (std::size_t i = places.size(); i-- > 0;) out.insert(places[i], name);
  for (const std::string_view what :
       {"stroke-linecap:butt;", "stroke-miterlimit:10;", "stroke-opacity:1;", "fill-opacity:1;",
        "fill-rule:nonzero;", " clip-rule=\"nonzero\"", " stroke:none;"})
    erase_all(out, what);
  return out;
}

// Strokes, words above them, notes above all.
std::string content_of(const Drawing& drawing, bool& is_sharp) {
  const double unit = drawing.unit / pixel_mm;
  std::string document;
  SvgParts parts;
  {
    const Held svg(cairo_svg_surface_create_for_stream(append, &document, unit * drawing.width,
                                                       unit * drawing.height));
    parts = draw_on(svg.surface, unit, true, drawing.draw);
    cairo_surface_finish(svg.surface);
    require(cairo_surface_status(svg.surface));
  }
  is_sharp = parts.is_sharp;
  std::string out = strokes_of(document) + parts.words;
  if (!parts.notes.empty())
    out += "<g fill=\"none\" stroke-width=\"6\">\n" + parts.notes + "</g>\n";
  return out;
}

}  // namespace

std::string png_of(const Drawing& drawing) {
  require_font();
  const double per_unit = drawing.unit * picture_dpi / mm_per_inch;
  const Held picture(cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(drawing.width * per_unit)),
      static_cast<int>(std::lround(drawing.height * per_unit))));
  draw_on_white(picture.surface, per_unit, drawing);
  leave_out_last_bits(picture.surface);
  std::string bytes;
  require(cairo_surface_write_to_png_stream(picture.surface, append, &bytes));
  return bytes;
}

std::string pdf_of(const Drawing& drawing) {
  require_font();
  const double per_unit = drawing.unit * points_per_mm;
  std::string bytes;
  const Held pdf(cairo_pdf_surface_create_for_stream(append, &bytes, drawing.width * per_unit,
                                                     drawing.height * per_unit));
  cairo_pdf_surface_set_metadata(pdf.surface, CAIRO_PDF_METADATA_TITLE, drawing.title.c_str());
  cairo_pdf_surface_set_metadata(pdf.surface, CAIRO_PDF_METADATA_CREATE_DATE, "");  // no time
  draw_on_white(pdf.surface, per_unit, drawing);
  cairo_surface_finish(pdf.surface);
  require(cairo_surface_status(pdf.surface));
  return bytes;
}

std::string svg_of(const Drawing& drawing, const std::string& css_class) {
  bool is_sharp = false;
  const std::string content = content_of(drawing, is_sharp);
  const double unit = drawing.unit / pixel_mm;
  const std::string width = text(unit * drawing.width, 7), height = text(unit * drawing.height, 7);
  const std::string kind =
      css_class.empty()
          ? "xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\""
          : "class=\"" + css_class + "\"";
  return "<svg " + kind + " viewBox=\"0 0 " + width + " " + height + "\" width=\"" + width +
         "\" height=\"" + height + "\" font-family=\"" + page_font + ", sans-serif\" font-size=\"" +
         text(base_letters) + "\"" + (is_sharp ? " image-rendering=\"pixelated\"" : "") +
         " role=\"img\" aria-label=\"" + xml_escaped(drawing.title) +
         "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>" + content + "</svg>\n";
}

std::string svg_group(const Drawing& drawing, const std::string& name) {
  bool is_sharp = false;
  const std::string content = content_of(drawing, is_sharp);
  return "<g " + name + (is_sharp ? " image-rendering=\"pixelated\"" : "") + ">" + content +
         "</g>\n";
}

void measure(const std::function<void(Pen&)>& draw) {
  const Held nowhere(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr));
  draw_on(nowhere.surface, 1, false, draw);
}

void require_font(const std::string& family) {
  PangoFontFamily** families = nullptr;
  int n = 0;
  pango_font_map_list_families(pango_cairo_font_map_get_default(), &families, &n);
  const bool is_there = std::any_of(families, families + n, [&family](PangoFontFamily* one) {
    return family == pango_font_family_get_name(one);
  });
  g_free(families);
  if (!is_there)
    throw InputError({}, "the font " + family + ", which maps are lettered with, is not installed",
                     "install it (Debian: apt-get install fonts-dejavu-core), or leave out "
                     "--pages");
}

void require_page_memory() {
  constexpr std::size_t pages = std::size_t{page_memory_mb} << 20;
  void* volatile room = std::malloc(pages);  // volatile: else it need not be asked for
  if (room == nullptr) throw std::bad_alloc();
  std::free(room);
}

}  // namespace talus
