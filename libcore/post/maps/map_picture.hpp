// libcore/post/maps/map_picture.hpp: public
// A map over the hillshade of its terrain, with its legend: what is looked at before anything is
// believed.
#pragma once

#include <vector>

#include "io/picture.hpp"
#include "io/style.hpp"
#include "record/passages.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Whether the ground is known anywhere below a cell (its centre or a corner)   (n_rows x n_cols)
[[nodiscard]] std::vector<bool> known_cells(const Trn& trn, const PassageGrid& grid);

/// The ground of a grid's extent lit from the north-west, for all pictures of one grid. Small grids
/// are enlarged by whole numbers of pixels, large ones taken down.
struct Shading {
  int n_rows = 0, n_cols = 0;     ///< pixels
  double per_cell = 1;            ///< pixels a cell
  std::vector<float> brightness;  ///< 0 to 255; NaN off the known ground        (n_rows x n_cols)
};
[[nodiscard]] Shading shading_of(const Trn& trn, const PassageGrid& grid);

/// Each cell in the colour of its class laid over the ground at 75 %; the legend on the right, the
/// style's remark in a red strip above, its notes below. `uncertain`: cells that are hatched in
/// black, and the legend says so; empty: none.
[[nodiscard]] Picture map_picture(const Shading& shading, const PassageGrid& grid,
                                  const std::vector<float>& value, float nodata,
                                  const RasterStyle& style,
                                  const std::vector<bool>& uncertain = {});

/// Words in capitals of strokes, `height` pixels high, at the upper left corner (row, col); lower
/// case is drawn as small capitals. Returns the column behind the last letter.
int draw_text(Picture& picture, int row, int col, int height, const std::string& words,
              const Colour& colour);

}  // namespace talus
