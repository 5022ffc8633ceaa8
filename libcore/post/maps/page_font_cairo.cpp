#include "post/maps/page_font_cairo.hpp"

#include <pango/pangocairo.h>

#include <algorithm>
#include <cstdlib>
#include <new>

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
