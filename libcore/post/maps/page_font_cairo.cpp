#include "post/maps/page_font_cairo.hpp"

#include <pango/pangocairo.h>

#include <algorithm>

#include "base/error.hpp"

namespace talus {

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
                     "install it (Debian: apt-get install fonts-dejavu-core), or leave out --png "
                     "and --pdf");
}

}  // namespace talus
