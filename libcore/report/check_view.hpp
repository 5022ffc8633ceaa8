// libcore/report/check_view.hpp: public
// Pictures of a site before anything is computed: a map of the source, what lies around it and the
// fall lines from it, a map of the inputs, and a section along the motion.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "draw/chart.hpp"
#include "post/maps/map_page.hpp"
#include "record/crossings.hpp"
#include "report/doubts_html.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Appearance of a block in a drawing.
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

/// An area with a name: an object, or a mass that could leave on a plane or wedge.
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

/// The part of the terrain that source, fences and fall lines lie in, with a margin, and of objects
/// the parts no farther from these than their extent.
[[nodiscard]] MapGround check_ground(const CheckView& view, const Trn& ground);

/// Whether a point of the object lies in the part that is drawn.
[[nodiscard]] bool is_drawn(const NamedArea& object, const MapView& part);

/// `part`: from check_ground().
[[nodiscard]] Drawing check_map(const CheckView& view, const Trn& ground, const MapGround& part);

/// A layer or raster that was read: its name, its content, and its extent in plan.
struct ViewedInput {
  std::string name, title;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
};

/// The whole terrain with the extent of each input, also of those that lie outside, the shapes and
/// doubts of the view.
[[nodiscard]] Drawing inputs_map(const CheckView& view, const std::vector<ViewedInput>& inputs,
                                 const Trn& ground);
/// Inputs that lie so far off the terrain that the map leaves them out.
[[nodiscard]] bool is_far(const ViewedInput& input, const Trn& ground);

/// Ground and bed along the section, heights and lengths at one scale; without series on flat
/// ground.
[[nodiscard]] Chart section_chart(const CheckView& view, const Trn& ground, const Trn& bed);

}  // namespace talus
