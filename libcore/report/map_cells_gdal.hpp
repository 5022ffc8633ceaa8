// libcore/report/map_cells_gdal.hpp: public
// Rasters of maps as pictures of a page.
// in:    NAME.tif and NAME.qml as the tools write them
// out:   PNG and values; the same bytes for the same input
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/map_sheet.hpp"

namespace talus {

/// The cells of the band that the style shows, as far as they lie in the view, in its colours.
/// Values have three digits; of more than 250,000 cells there are none. Throws InputError when the
/// file is not a raster.
[[nodiscard]] CellPicture read_cell_picture(const std::string& path, const std::string& qml,
                                            const MapView& view, const Vec2& origin);

/// Hatches cells of a map of classes: those of the codes `weak`, and in black those where the first
/// band of `certain`, of the same cells, is 0. Throws InputError as read_cell_picture.
void hatch_classes(MapCells& cells, const std::string& certain, const std::vector<int>& weak,
                   const MapView& view, const Vec2& origin);

/// South-western and north-eastern corner of the cells that the pages of a map show, map
/// coordinates [m]; none for a map without pages.
[[nodiscard]] std::optional<std::pair<Vec2, Vec2>> cells_on_pages(const std::string& path);

}  // namespace talus
