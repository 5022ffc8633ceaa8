// libcore/draw/drawing.hpp: public
// A drawing as a file: PNG, PDF or SVG of the same strokes. Equal drawings give equal bytes.
#pragma once

#include <functional>
#include <string>

#include "draw/pen.hpp"

namespace talus {

inline constexpr double pixel_mm = 25.4 / 96;  ///< of an SVG

struct Drawing {
  double width = 0, height = 0;
  std::string title;       ///< in words, for readers who do not see it
  double unit = pixel_mm;  ///< of all lengths of the drawing [mm]
  std::function<void(Pen&)> draw;
};

/// Pixels of a PNG.
inline constexpr double picture_dpi = 150;

/// On white, at picture_dpi. Throws InputError as require_font().
[[nodiscard]] std::string png_of(const Drawing& drawing);
/// One page; it holds no time of its making. Throws InputError as require_font().
[[nodiscard]] std::string pdf_of(const Drawing& drawing);
/// A document, or part of a page, where it has a class. Words stay words: they can be searched, and
/// grow and shrink with the font size.
[[nodiscard]] std::string svg_of(const Drawing& drawing, const std::string& css_class = {});
/// The strokes alone, as a group of an SVG of this size; `name`: its id or class, as an attribute.
[[nodiscard]] std::string svg_group(const Drawing& drawing, const std::string& name);

/// Calls draw() on a drawing that is not kept; results come back by reference: sizes of words.
void measure(const std::function<void(Pen&)>& draw);

/// The family of letters.
inline constexpr const char* page_font = "DejaVu Sans";
/// Throws InputError with a remedy where `family` is not installed: another family would be drawn,
/// or none.
void require_font(const std::string& family = page_font);

/// Room for addresses that drawing of pages takes [MB]. Measured: 325 for PNG and PDF.
inline constexpr int page_memory_mb = 350;
/// Asks for it and gives it back: Pango and GLib end the program where they get none. Throws
/// std::bad_alloc. Before the first page, not between pages.
void require_page_memory();

}  // namespace talus
