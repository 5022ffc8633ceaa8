// libcore/record/crossings.hpp: public
// When, where and how blocks cross lines: fences and virtual lines that stop nothing.
// in:    the solver's segments; polylines with a height at each point
// out:   one row per block and line, exact in time for the motion between two steps
//
// A line continues straight beyond both ends, so that a block that passes beside a fence is known
// to have done so: its chainage is negative or greater than the line's length. The centroid
// crosses, in plan. A crossing of the line itself replaces an earlier one beside it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "step/segment.hpp"
#include "terrain/dam.hpp"

namespace talus {

struct Scene;

/// A line that is watched; its base is straight between points.
struct RecordLine {
  std::string name;
  std::vector<Vec3> points;       ///< local, z = base of the line [m]; at least two, no two alike
  std::vector<double> chainage;   ///< of the points, horizontal, from the first [m]  (n_points)
  bool standing = false;          ///< a fence that stops blocks; false: a line that stops nothing
  std::vector<RoofPiece> roof{};  ///< of a gallery, at its line; not in files
  std::vector<int> roof_nodes{};  ///< nodes of the terrain at the roof's height, ascending; as roof
};

/// Where a search considers a fence: lines of this name are watched, though the site has no fence
/// there. Their names are that of the search and a number.
inline constexpr std::string_view candidate_prefix = "fence_search.";
[[nodiscard]] inline bool is_candidate(const RecordLine& line) {
  return line.name.starts_with(candidate_prefix);
}

/// Lines at a dam or gallery that stands in the terrain: the crest of a dam, or the valley edge of
/// a roof, which has the name behind these, and the line before the dam's uphill face, or the
/// uphill edge of the roof, which ends in `before_dam`.
inline constexpr std::string_view dam_prefix = "dam.", gallery_prefix = "gallery.",
                                  before_dam = ".before";
[[nodiscard]] inline bool is_gallery(const RecordLine& line) {
  return line.name.starts_with(gallery_prefix);
}
[[nodiscard]] inline bool is_dam(const RecordLine& line) {
  return line.name.starts_with(dam_prefix) || is_gallery(line);
}
[[nodiscard]] inline bool is_before_dam(const RecordLine& line) {
  return is_dam(line) && line.name.ends_with(before_dam);
}

/// The corners of a line and, between them, posts at equal distances not longer than `spacing`, all
/// on the ground. Throws InputError at `where` for fewer than two corners, two in a row at the same
/// place, more than 1e4 posts, and for a post outside the known terrain.
[[nodiscard]] std::vector<Vec3> posts_on_ground(const Trn& trn, const std::vector<Vec2>& corners,
                                                double spacing, const Where& where);

/// Chainages of `points`. Throws InputError naming the line for fewer than two points, or two in
/// a row at the same place.
[[nodiscard]] RecordLine record_line(std::string name, std::vector<Vec3> points);

/// Where a straight path in plan meets a line.
struct LineMeeting {
  int segment = 0;      ///< of the line, from 0
  int direction = 0;    ///< +1: to the left of the line seen from its first point, -1: right
  double share = 0;     ///< of the path, 0 to 1 [-]
  double chainage = 0;  ///< from the line's first point [m]
};
/// In the order of the path from `a` to `b`. Consecutive path segments meet the line as often as
/// the whole path: no meeting is missed or seen twice where one ends on the line or at a corner. A
/// path beside the ends does not meet it.
[[nodiscard]] std::vector<LineMeeting> line_meetings(const RecordLine& line, const Vec2& a,
                                                     const Vec2& b);

struct Crossing {
  std::int32_t block = 0, line = 0;
  std::int32_t segment = 0;    ///< of the line, from 0
  std::int32_t direction = 0;  ///< +1: to the left of the line seen from its first point, -1: right
  std::int32_t n_crossings = 0;     ///< of the line itself so far, returns included
  double time = 0;                  ///< [s]
  double chainage = 0;              ///< of the place, from the line's first point [m]
  Vec3 position = Vec3::Zero();     ///< of the centroid, local [m]
  Vec3 velocity = Vec3::Zero();     ///< [m/s]
  Vec3 spin = Vec3::Zero();         ///< local axes [rad/s]
  double translational_energy = 0;  ///< [J]
  double rotational_energy = 0;     ///< [J]
  double centroid_height = 0;       ///< above the line's base there [m]
  double top_height = 0;            ///< of the highest vertex above the base [m]
  double bottom_height = 0;         ///< of the lowest vertex above the base [m]
  bool beside = false;              ///< beyond an end of the line
};

struct CrossingRecorder {
  std::vector<RecordLine> lines;
  std::vector<Crossing> rows;        ///< in the order of the first crossing
  std::vector<std::int32_t> row_of;  ///< row of block b and line l at [b * n_lines + l], -1 none
  std::vector<double> clearance;  ///< block b meets no line before it moves so far [m]  (n_blocks)
};

[[nodiscard]] CrossingRecorder start_crossings(const Scene& scene, std::vector<RecordLine> lines);

/// The next segment of a block; segments of one block come in the order of time.
void record_crossings(CrossingRecorder& recorder, const Scene& scene, const Segment& segment);

/// Rows to be written, in the order of line, then block.
[[nodiscard]] std::vector<Crossing> sorted(const CrossingRecorder& recorder);

}  // namespace talus
