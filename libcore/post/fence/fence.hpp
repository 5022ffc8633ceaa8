// libcore/post/fence/fence.hpp
// Arrivals of blocks at fences and the fate of each block there.
// in:    crossings of the fences' lines, recorded where nothing stops the blocks, or with the fence
//        built, then with the touches of its panels; the terrain
// out:   one verdict a block, storage behind the fence
// Definitions: docs/reference/formats.md#fence
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "post/deposit.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A fence on the terrain. Its base is straight from post foot to post foot.
struct Fence {
  std::string name;
  std::vector<Vec3> post;        ///< feet, local [m]                               (n_posts)
  std::vector<double> chainage;  ///< of the posts, horizontal, from the first [m]  (n_posts)
  double height = 0;             ///< above the base [m]
  double capacity = 0;           ///< kinetic energy that a field takes [J]; NaN: not known
};
[[nodiscard]] inline int n_fields(const Fence& fence) {
  return static_cast<int>(fence.post.size()) - 1;
}
[[nodiscard]] inline double length(const Fence& fence) { return fence.chainage.back(); }

/// The posts are the line's points (posts_on_ground).
[[nodiscard]] Fence make_fence(const RecordLine& line, const FenceSettings& settings);

/// Height of the base at a chainage; beyond the ends that of the end [m].
[[nodiscard]] double base_at(const Fence& fence, double chainage);

enum class Verdict {
  stopped,         ///< came at the fence below its freeboard with no more energy than its capacity
  pierced,         ///< came with more energy than the capacity
  free_border,     ///< top above h - f_min, bottom not above h: the border or the rope is hit
  overtopped,      ///< bottom above h
  bypassed_left,   ///< passed beside the end on the left, seen in the direction of moving
  bypassed_right,  ///< on the right
  underpassed,     ///< top below the base: through a dip between two posts
  not_reached,     ///< neither crossed the line nor passed beside it
};
inline constexpr std::array verdicts = {
    Verdict::stopped,       Verdict::pierced,        Verdict::free_border, Verdict::overtopped,
    Verdict::bypassed_left, Verdict::bypassed_right, Verdict::underpassed, Verdict::not_reached};
[[nodiscard]] const char* text(Verdict verdict);

/// A block at a fence: as it crossed the line, or as it first touched a panel. Heights are above
/// the fence's own base.
struct FenceArrival {
  int run = 0, block = 0;
  double weight = 1;
  double time = 0;            ///< [s]
  double chainage = 0;        ///< [m]
  bool by_touch = false;      ///< its state before the first touch; else at the crossing
  bool beside = false;        ///< beyond an end
  int direction = 0;          ///< +1 to the left of the line seen from its first point, -1 right
  int field = -1, post = -1;  ///< of the chainage; nearest post; -1 beside
  double speed = 0;           ///< [m/s]
  double angle = 0;           ///< between the horizontal velocity and the field's normal [rad]
  double spin = 0;            ///< NaN by touch [rad/s]
  double translation = 0, rotation = 0;      ///< [J]
  double centroid = 0, top = 0, bottom = 0;  ///< heights above the base; centroid NaN by touch [m]
  double volume = 0;                         ///< [m3]
  int world = 0;  ///< of its block in its run (worlds_of): arrivals of one world meet one fence
  bool passed_for_good = false;  ///< a crossing that ended on the far side: an odd number of times
  [[nodiscard]] double energy() const { return translation + rotation; }
};

/// Where an arrival is drawn: on the line, at the height of its centroid, or by touch at half the
/// height of the block, local [m]. Beyond an end the line continues straight.
[[nodiscard]] Vec3 place_of(const FenceArrival& arrival, const Fence& fence);

/// All crossings of one line of a run, by block. The arrivals carry `run`.
[[nodiscard]] std::vector<FenceArrival> line_crossings(const RunFile& file, int line,
                                                       const Fence& fence, int run);

/// Arrivals at a fence: a block that touched panels as it was before the first touch, when the
/// fence had taken no energy from it; any other block as it crossed the line. By block, one each.
[[nodiscard]] std::vector<FenceArrival> arrivals(const RunFile& file, int line, const Fence& fence,
                                                 int run);

/// Where nothing stopped the blocks: the fate that an arrival would have. `free_border`: f_min [m].
/// The order of precedence: beside, underpassed, overtopped, pierced, freeboard, stopped.
[[nodiscard]] Verdict expected_verdict(const FenceArrival& arrival, const Fence& fence,
                                       double free_border);

/// With the fence built: a crossing means that the block came through, and how. Blocks that did
/// not cross were stopped when any part of them came within `contact` of the line in any frame [m],
/// else they did not reach it.
[[nodiscard]] Verdict observed_verdict(const FenceArrival& arrival, const Fence& fence,
                                       double free_border);
[[nodiscard]] bool came_near(const RunFile& file, int block, const Fence& fence, double contact);

/// A block in the record of a fence that is built.
struct FenceTouch {
  static constexpr double never = std::numeric_limits<double>::infinity();
  double time = never;       ///< of its first touch [s]
  double gap_since = never;  ///< when the panel broke where its centroid crossed the line [s]
  bool held = false;  ///< crossed, but lies at the end no farther beyond the line than a panel that
                      ///< active, there or where the block touched it, was pushed
};
/// Of each block, at one line; `crossings` of that line                               (n_blocks)
[[nodiscard]] std::vector<FenceTouch> touches(const RunFile& file, int line, const Fence& fence,
                                              const std::vector<FenceArrival>& crossings);

/// With the record of hits: a block is stopped that touched a panel and did not cross, or crossed
/// in a panel that yielded and still holds it. `crossing`: null when it did not cross. Passing
/// beside an end counts when it comes after the touch; before it, the block came to the fence round
/// a wing that is turned uphill.
[[nodiscard]] Verdict touched_verdict(const FenceTouch& touch, const FenceArrival* crossing,
                                      const Fence& fence, double free_border);

/// A verdict for each block of a run, exactly one. Where the run recorded panels at `line`, hits
/// say who touched the fence; else nearness in frames does (came_near).
struct BlockVerdict {
  int run = 0, block = 0;
  Verdict verdict = Verdict::not_reached;
  int arrival = -1;  ///< index among the run's arrivals(), -1 none
};
[[nodiscard]] std::vector<BlockVerdict> verdicts_of(const RunFile& file, int run, int line,
                                                    const std::vector<FenceArrival>& arrivals,
                                                    const Fence& fence, double free_border,
                                                    bool standing, double contact);

/// The side of a fence on which the ground lies higher, at its height from the line: from where
/// blocks come when none has. +1 left, -1 right.
[[nodiscard]] int uphill_side(const Fence& fence, const Trn& trn);

/// Space behind a field up to a horizontal fill at the fence's height [m3]: the ground on the side
/// where blocks come from, walked along the field's normal until it meets the fill or falls more
/// than the fence's height below its base, where the fence holds nothing; at most `reach` [m] far.
/// `side`: +1 the left of the line seen from its first point, -1 the right.
[[nodiscard]] double storage(const Fence& fence, int field, int side, const Trn& trn, double reach);

}  // namespace talus
