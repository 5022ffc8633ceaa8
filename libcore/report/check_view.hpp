// libcore/report/check_view.hpp: public
// Pictures of a site before anything is computed: a map of the source, what lies around it and the
// fall lines from it, and a section along the motion, both as SVG.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "record/crossings.hpp"
#include "report/doubts_html.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// What a block is drawn as.
enum class BlockOutlook : std::uint8_t { goes, stays, holds_others };

struct OutlinedBlock {
  std::vector<Vec2> outline;  ///< in plan
  BlockOutlook outlook = BlockOutlook::goes;
  std::string title;
};
/// A point of the foot and the height of the step there.
struct FootMark {
  Vec2 place = Vec2::Zero();
  double step = 0;     ///< [m]
  bool holds = false;  ///< it is not low for the blocks
};

struct ViewedFence {
  RecordLine line;    ///< on the ground
  double height = 0;  ///< [m]
};

/// An area with a name: an object, or what could leave on a plane or wedge.
struct NamedArea {
  std::string name, title;
  std::vector<std::vector<std::vector<Vec2>>> polygons;  ///< polygon, ring, points
};

struct CheckView {
  std::vector<std::vector<Vec2>> source;  ///< outlines
  std::vector<ViewedFence> fences;
  std::vector<std::uint8_t> cell_class;       ///< of the ground; empty: one class     (n_cells)
  std::vector<std::vector<Vec2>> fall_lines;  ///< from the source down
  std::vector<OutlinedBlock> blocks;
  std::vector<FootMark> foot;
  std::vector<Vec2> section;  ///< line of the section
  std::vector<NamedArea> objects;
  std::vector<NamedArea> surfaces;  ///< that the mass could leave on
  std::vector<DoubtMark> doubts;
};

/// Elevation interval of contours that makes about twenty of them between two heights: 1, 2, 5 or
/// 10 times a power of ten [m].
[[nodiscard]] double contour_interval(double low, double high);
/// Of this ground; 0 where it has no relief [m].
[[nodiscard]] double contour_interval(const Trn& ground);

/// The part of the terrain that source, fences and fall lines lie in, with a margin, and of objects
/// what is no farther from these than their extent.
[[nodiscard]] Trn part_for(const CheckView& view, const Trn& ground);

/// Whether a point of the object lies in the part that is drawn.
[[nodiscard]] bool is_drawn(const NamedArea& object, const Trn& part);

/// `ground`: what part_for() gave; `hillshade_png`: a pixel a node of it.
[[nodiscard]] std::string check_map_svg(const CheckView& view, const Trn& ground,
                                        std::string_view hillshade_png);

/// A layer or raster that was read: its name, what is in it, and its extent in plan.
struct ViewedInput {
  std::string name, title;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
};

/// Every nth node, so that there are `most` along a side at most.
[[nodiscard]] Trn thinned(const Trn& ground, int most);

/// The whole terrain with the extent of each input, also of those that lie outside, the shapes and
/// doubts of the view. `hillshade_png`: a pixel a node of `ground`.
[[nodiscard]] std::string inputs_map_svg(const CheckView& view,
                                         const std::vector<ViewedInput>& inputs, const Trn& ground,
                                         std::string_view hillshade_png);
/// Inputs that lie so far off the terrain that the map leaves them out.
[[nodiscard]] bool is_far(const ViewedInput& input, const Trn& ground);

/// Ground and bed along the section, heights and lengths at one scale.
[[nodiscard]] std::string section_svg(const CheckView& view, const Trn& ground, const Trn& bed);

}  // namespace talus
