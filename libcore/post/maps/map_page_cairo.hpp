// libcore/post/maps/map_page_cairo.hpp: public
// A map drawn as a page: the same drawing as picture and as PDF.
#pragma once

#include <string>

#include "post/maps/map_page.hpp"

namespace talus {

/// Pixels of a picture of a page.
inline constexpr double picture_dpi = 150;

/// The bytes of a PNG file at picture_dpi. Equal content gives equal bytes. Throws InputError as
/// require_font().
[[nodiscard]] std::string map_page_png(const MapPage& page, const MapGround& ground,
                                       const MapPlaces& places);
/// The bytes of a PDF file of one page; it holds no time of its making.
[[nodiscard]] std::string map_page_pdf(const MapPage& page, const MapGround& ground,
                                       const MapPlaces& places);

}  // namespace talus
