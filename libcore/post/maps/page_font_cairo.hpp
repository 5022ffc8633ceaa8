// libcore/post/maps/page_font_cairo.hpp: public
// The letters of pages.
#pragma once

#include <string>

namespace talus {

/// The family of letters that pages are drawn with.
inline constexpr const char* page_font = "DejaVu Sans";

/// Throws InputError with the way out where `family` is not installed: another one would be drawn,
/// or none.
void require_font(const std::string& family = page_font);

/// Room for addresses that drawing of pages takes [MB]. Measured: 325 for PNG and PDF.
inline constexpr int page_memory_mb = 350;
/// Asks for it and gives it back: Pango and GLib end the program where they get none. Throws
/// std::bad_alloc. Before the first page, not between pages.
void require_page_memory();

}  // namespace talus
