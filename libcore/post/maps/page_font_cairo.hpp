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

}  // namespace talus
