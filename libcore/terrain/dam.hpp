// libcore/terrain/dam.hpp: public
// Dams of earth, and ditches at the foot of their uphill faces, burnt into a terrain; galleries as
// their roofs.
// in:    the middle of the crest in plan, the cross-section; a terrain
// out:   nodes of the terrain on dam and ditch moved, all others bit for bit as they were; volumes
// Definitions: docs/guide/dams.md
#pragma once

#include <vector>

#include "terrain/trn.hpp"

namespace talus {

/// A dam as it is designed. The crest is straight between the points of its line. That of a gallery
/// is its roof, which ends with the line; its sides are vertical: slopes and ditch are not read.
struct DamShape {
  std::vector<Vec2> line;   ///< middle of the crest, local x, y; at least two, no two alike [m]
  double height = 0;        ///< of the crest above the ground at each point of the line [m]
  double crest_width = 0;   ///< > 0 [m]
  double tan_uphill = 0;    ///< slope of the uphill face across the line, > 0 [-]
  double tan_downhill = 0;  ///< of the downhill face, and of the ditch's far side [-]
  double ditch_depth = 0;   ///< below the foot of the uphill face; 0: no ditch [m]
  double ditch_width = 0;   ///< of its bottom [m]
  bool is_gallery = false;
};

/// A dam on the ground that was there before it.
struct Dam {
  DamShape shape;
  std::vector<Vec3> crest;  ///< points of the line at the height of the crest, local   (n_points)
  std::vector<Vec3> foot;   ///< where the uphill face meets the ground across each; of a gallery
                            ///< the crest                                              (n_points)
  int uphill = 1;           ///< +1: left of the line seen from its first point, -1: right
  double least_height = 0, most_height = 0;  ///< of the crest above the ground along the line [m]
};

/// What cannot be built there: why, and where on the ground.
struct DamFault {
  enum Kind { none, off_the_ground, uphill_face, downhill_face, ditch_side } kind = none;
  Vec2 at = Vec2::Zero();  ///< local
};

/// How far from the line the ground is looked at for the side on which it lies higher [m].
[[nodiscard]] double side_distance(const DamShape& shape);
/// How much higher the ground lies there on the left than on the right.
struct SideRise {
  double mean = 0;         ///< over the line [m]
  double other_share = 0;  ///< of the line's length, where the other side is higher [-]
};
[[nodiscard]] SideRise rise_to_the_left(const Trn& ground, const DamShape& shape);

/// Lays the dam on the ground. The side on which the ground lies higher is uphill. A point of the
/// line off the known ground, and an uphill face that does not meet the ground within ten heights,
/// are faults.
[[nodiscard]] DamFault lay_dam(const Trn& ground, const DamShape& shape, Dam& dam);

struct Earthwork {
  double fill = 0, cut = 0;  ///< between the ground before and after [m3]
};

/// What burning a dam did.
struct DamBurn {
  DamFault fault;          ///< none, or nothing was changed
  Earthwork designed;      ///< of the dam itself on the ground between the nodes; of a gallery that
                           ///< in the cells
  Earthwork in_cells;      ///< of the terrain, which has a height a node
  std::vector<int> nodes;  ///< that were moved, ascending
  double crest_loss = 0;   ///< most that the terrain lies below the crest along the line [m]
  Vec2 crest_loss_at = Vec2::Zero();
};

/// Moves the nodes of `trn` that stand on the dam or in its ditch:
/// z = max(min(ground, ditch), dam), as far as these reach from the line without a gap. A face or
/// a side of the ditch that runs on over unknown ground, over the border, or for more than ten
/// heights from the line is a fault.
[[nodiscard]] DamBurn burn_dam(const Dam& dam, Trn& trn);

/// A convex piece of a roof: of a straight piece of its line, or of the outer side of a corner. The
/// roof is level across the line.
struct RoofPiece {
  std::vector<Vec2> ring;       ///< in plan, counter-clockwise, local [m]
  Vec3 normal = Vec3::UnitZ();  ///< upwards
};
/// Of a gallery that stands in `trn`. The pieces overlap. One of less than four cells is taken as
/// level, as its ends in the terrain are lower than it.
[[nodiscard]] std::vector<RoofPiece> roof_pieces(const Trn& trn, const DamShape& gallery);

/// The line at a distance to the left, < 0 right: round at the outer side of a corner, as faces and
/// roof are; at the inner side where its pieces meet, but no farther than one of them is long.
[[nodiscard]] std::vector<Vec2> line_beside(const std::vector<Vec2>& line, double distance);

/// How many corners of the triangle at a place are among `nodes`, which ascend.
[[nodiscard]] int corners_among(const Trn& trn, const std::vector<int>& nodes, const Vec2& at);
/// Whether a dam, a ditch or a gallery of the terrain moved a corner of the triangle there.
[[nodiscard]] bool is_on_a_dam(const Trn& trn, const Vec2& at);

/// Height of the dam's crest and faces above a place, and of its ditch; minus and plus infinity
/// where the dam has none, local [m].
[[nodiscard]] double dam_height_at(const Dam& dam, const Vec2& at);
[[nodiscard]] double ditch_height_at(const Dam& dam, const Vec2& at);

}  // namespace talus
